//! Reads the tables and matrices of a scene file into the scene.

use super::{Reader, SceneFiles, put_condition};
use crate::scene::file::{self, LinkFileEntry};
use crate::scene::{Field, Scene, SceneInterface, SceneLink, matrix, tables};
use inpact_diagnostics::{Findings, keep_lines};
use inpact_evaluation::nodes::locate;
use toml::Spanned;

impl Reader<'_> {
    pub(super) fn take_node_file(&mut self, name: &Spanned<String>, files: &mut dyn SceneFiles, scene: &mut Scene) {
        let source = self.sources.len();
        self.sources.push(name.as_ref().clone());
        let is_whole = self.take_file(name, files, |reader, text, findings| {
            tables::nodes(text, findings, &mut |row| {
                let number = reader.define_at(&row.name, (source, row.line), scene)?;
                for (field, condition) in Field::ALL.into_iter().zip(row.conditions) {
                    put_condition(scene, field, number, condition);
                }
                Ok(())
            });
        });
        self.lacks_nodes |= !is_whole;
    }

    /// The links of a matrix, whose rows are nodes; `None` for a table.
    pub(super) fn take_matrix(
        &mut self,
        entry: &LinkFileEntry,
        joule_heat_fraction: f64,
        files: &mut dyn SceneFiles,
        scene: &mut Scene,
    ) -> Option<Vec<SceneLink>> {
        if !is_matrix(entry.file.as_ref()) {
            return None;
        }
        let mut links = Vec::new();
        let is_whole = self.take_file(&entry.file, files, |reader, text, findings| {
            matrix::matrix(text, entry.conducts.map(field_of), findings, &mut |ends: [u32; 2], conductances| {
                let nodes = ends.map(|end| reader.number_or_new(&format!("{}{end}", entry.prefix), scene));
                links.push(SceneLink { nodes, conductances, joule_heat_fraction });
            });
        });
        self.lacks_nodes |= !is_whole;
        Some(links)
    }

    pub(super) fn take_link_file(
        &mut self,
        name: &Spanned<String>,
        defines_nodes: bool,
        default: f64,
        files: &mut dyn SceneFiles,
        scene: &mut Scene,
    ) {
        let is_whole = self.take_file(name, files, |reader, text, findings| {
            tables::links(text, findings, &mut |row| {
                let mut numbers = [None; 2];
                for (end, name) in row.nodes.iter().enumerate() {
                    numbers[end] = if defines_nodes {
                        Some(reader.number_or_new(name, scene))
                    } else {
                        reader.known(name, scene).map_err(|refusal| (end, refusal))?
                    };
                }
                if let [Some(first), Some(second)] = numbers {
                    let joule_heat_fraction = row.joule_heat_fraction.unwrap_or(default);
                    let (nodes, conductances) = ([first, second], row.conductances);
                    scene.links.push(SceneLink { nodes, conductances, joule_heat_fraction });
                }
                Ok(())
            });
        });
        self.lacks_nodes |= defines_nodes && !is_whole;
    }

    pub(super) fn take_interface_file(
        &mut self,
        name: &Spanned<String>,
        files: &mut dyn SceneFiles,
        scene: &mut Scene,
    ) {
        self.take_file(name, files, |reader, text, findings| {
            tables::interfaces(text, findings, &mut |row| {
                let slave = reader.known(&row.slave, scene).map_err(|refusal| (0, refusal))?;
                let master = reader.known(&row.master, scene).map_err(|refusal| (1, refusal))?;
                if let (Some(slave), Some(master)) = (slave, master) {
                    let place = (row.interface.place.0, Some(name.as_ref().clone()));
                    scene.interfaces.push(SceneInterface { slave, master, place, ..row.interface });
                }
                Ok(())
            });
        });
    }

    /// Reads a table of the scene; whether it has no faults.
    pub(super) fn take_file(
        &mut self,
        name: &Spanned<String>,
        files: &mut dyn SceneFiles,
        take: impl FnOnce(&mut Self, &[u8], &mut Findings),
    ) -> bool {
        let Some(bytes) = files.read(name.as_ref()) else { return false };
        let mut findings = Findings::new(&files.name(name.as_ref()));
        take(self, &bytes, &mut findings);
        let is_whole = !findings.has_errors();
        let mut found = findings.into_list();
        // Bytes in memory are readable; a matrix has no cells under headers.
        if !is_matrix(name.as_ref()) {
            let _ = locate(&*bytes, &mut found);
        }
        let _ = keep_lines(&*bytes, &mut found);
        self.found.append(&mut found);
        is_whole
    }
}

/// Whether a file is a Matrix Market file by its name.
fn is_matrix(name: &str) -> bool {
    name.to_ascii_lowercase().ends_with(".mtx")
}

fn field_of(conducts: file::Conducts) -> Field {
    match conducts {
        file::Conducts::Electrical => Field::Potential,
        file::Conducts::Thermal => Field::Temperature,
        file::Conducts::Hydraulic => Field::PorePressure,
    }
}
