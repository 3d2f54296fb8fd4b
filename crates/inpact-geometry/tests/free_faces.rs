//! Free faces of blocks of bricks, wedges and tetrahedra.

use inpact_geometry::{ElementShape, FaceLabel, FreeFaces, NodeId};
use std::collections::BTreeMap;

fn bricks([n, m, l]: [u32; 3]) -> Vec<Vec<NodeId>> {
    let node = |i: u32, j: u32, k: u32| NodeId((k * (m + 1) + j) * (n + 1) + i);
    let mut elements = Vec::new();
    for k in 0..l {
        for j in 0..m {
            for i in 0..n {
                let square = |k: u32| [node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)];
                elements.push([square(k), square(k + 1)].concat());
            }
        }
    }
    elements
}

#[test]
fn a_block_has_the_faces_of_its_skin() {
    let mut free = FreeFaces::new();
    for (element, nodes) in (0..).zip(bricks([4, 3, 2])) {
        free.add(element, ElementShape::Hexahedron8, &nodes);
    }
    let faces = free.finish();
    assert_eq!(faces.len(), 2 * (4 * 3 + 3 * 2 + 4 * 2));
    assert_eq!(faces.iter().filter(|(_, label)| *label == FaceLabel::Numbered(1)).count(), 12);
    // The first brick is at a corner of the block.
    let first: Vec<String> =
        faces.iter().filter(|(element, _)| *element == 0).map(|(_, label)| label.to_string()).collect();
    assert_eq!(first, ["S1", "S3", "S6"]);
}

#[test]
fn elements_that_are_not_wanted_cover_those_that_are() {
    let elements = bricks([3, 1, 1]);
    let mut free = FreeFaces::new();
    free.cover(ElementShape::Hexahedron8, &elements[0]);
    free.add(1, ElementShape::Hexahedron8, &elements[1]);
    free.add(2, ElementShape::Hexahedron8, &elements[2]);
    let faces: Vec<String> = free.finish().iter().map(|(element, label)| format!("{element}.{label}")).collect();
    assert_eq!(faces, ["1.S1", "1.S2", "1.S3", "1.S5", "2.S1", "2.S2", "2.S3", "2.S4", "2.S5"]);
}

/// A brick whose face is folded to an edge is a wedge: the folded face is none.
#[test]
fn a_folded_face_is_not_free() {
    let mut free = FreeFaces::new();
    free.add(0, ElementShape::Hexahedron8, &[0, 1, 2, 2, 3, 4, 5, 5].map(NodeId));
    let labels: Vec<String> = free.finish().iter().map(|(_, label)| label.to_string()).collect();
    assert_eq!(labels, ["S1", "S2", "S3", "S4", "S6"]);
    // Its triangular end meets that of a real wedge on the other side.
    let mut free = FreeFaces::new();
    free.add(0, ElementShape::Hexahedron8, &[0, 1, 2, 2, 3, 4, 5, 5].map(NodeId));
    free.add(1, ElementShape::Wedge6, &[3, 4, 5, 6, 7, 8].map(NodeId));
    let faces = free.finish();
    assert!(!faces.contains(&(0, FaceLabel::Numbered(2))), "{faces:?}");
    assert!(!faces.contains(&(1, FaceLabel::Numbered(1))), "{faces:?}");
}

#[test]
fn second_order_faces_meet_by_their_corners() {
    let corners = [[0, 1, 2, 3], [0, 2, 1, 4]];
    let mut free = FreeFaces::new();
    for (element, corners) in (0..).zip(corners) {
        let nodes: Vec<NodeId> =
            corners.into_iter().chain(10 * (element + 1)..10 * (element + 1) + 6).map(NodeId).collect();
        free.add(element.into(), ElementShape::Tetrahedron10, &nodes);
    }
    assert_eq!(free.finish().len(), 6);
}

type Element = (ElementShape, Vec<NodeId>);

/// The free faces by a table of all faces.
fn counted(elements: &[Element]) -> Vec<(u64, FaceLabel)> {
    let mut owners: BTreeMap<Vec<NodeId>, Vec<(u64, FaceLabel)>> = BTreeMap::new();
    for (element, (shape, nodes)) in (0..).zip(elements) {
        for face in shape.faces() {
            let corners = &face.nodes[..face.shape.corners()];
            let mut corners: Vec<NodeId> = corners.iter().map(|local| nodes[usize::from(*local)]).collect();
            corners.sort_unstable();
            owners.entry(corners).or_default().push((element, face.label));
        }
    }
    let mut free: Vec<_> = owners.into_values().filter(|owners| owners.len() == 1).flatten().collect();
    free.sort_unstable();
    free
}

fn found(elements: &[Element]) -> Vec<(u64, FaceLabel)> {
    let mut free = FreeFaces::new();
    for (element, (shape, nodes)) in (0..).zip(elements) {
        free.add(element, *shape, nodes);
    }
    free.finish()
}

/// Bricks, or two wedges for each; all are cut along the same diagonal, so that the halves of neighbours meet.
fn cut_or_not(shape: ElementShape, number: fn(u32) -> u32) -> Vec<Element> {
    let element = |nodes: &[NodeId]| (shape, nodes.iter().map(|node| NodeId(number(node.0))).collect());
    let halves = |nodes: Vec<NodeId>| match (shape, &nodes[..]) {
        (ElementShape::Wedge6, [a, b, c, d, e, f, g, h]) => {
            vec![element(&[*a, *b, *c, *e, *f, *g]), element(&[*a, *c, *d, *e, *g, *h])]
        }
        (_, nodes) => vec![element(nodes)],
    };
    bricks([13, 12, 11]).into_iter().flat_map(halves).collect()
}

/// Whatever the numbers of the nodes and the order of the elements: only the way through the memory depends on them.
#[test]
fn free_faces_are_those_that_a_count_of_all_finds() {
    // In order, far apart, all at one place among the recent faces, and without order.
    let numberings: [fn(u32) -> u32; 4] =
        [|node| node + 1, |node| 1000 * node + 7, |node| node << 18, |node| node.wrapping_mul(0x9E37_79B1)];
    for number in numberings {
        for shape in [ElementShape::Hexahedron8, ElementShape::Wedge6] {
            let mut elements = cut_or_not(shape, number);
            assert_eq!(found(&elements), counted(&elements));
            // Nearly every face has to wait for long, and neighbours are not near.
            for at in 0..elements.len() {
                let other = (7919 * at + 13) % elements.len();
                elements.swap(at, other);
            }
            assert_eq!(found(&elements), counted(&elements));
        }
    }
}

/// A plane of quadrilaterals, whose faces are edges.
#[test]
fn edges_of_a_plane_mesh_are_those_that_a_count_of_all_finds() {
    let squares = bricks([90, 80, 1]).into_iter();
    let elements: Vec<Element> = squares.map(|nodes| (ElementShape::Quadrilateral4, nodes[..4].to_vec())).collect();
    assert_eq!(found(&elements).len(), 2 * (90 + 80));
    assert_eq!(found(&elements), counted(&elements));
}
