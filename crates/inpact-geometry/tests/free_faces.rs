//! Free faces of blocks of bricks, wedges and tetrahedra.

use inpact_geometry::{ElementShape, FaceLabel, FreeFaces, NodeId};

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
