//! `docs/extremes.md` is what the evaluation does today.

use std::path::Path;

/// The whole page, its ten million steps included: nothing of it is shortened here.
#[test]
fn the_page_of_extremes_is_fresh() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/extremes.md");
    let page = inpact_bench::extremes::page();
    if std::env::var_os("INPACT_UPDATE").is_some() {
        std::fs::create_dir_all(path.parent().expect("it is in a folder")).expect("a folder");
        std::fs::write(&path, &page).expect("writable");
    }
    let written = std::fs::read_to_string(&path).unwrap_or_default();
    for (number, (written, computed)) in written.lines().zip(page.lines()).enumerate() {
        assert_eq!(written, computed, "line {}; INPACT_UPDATE=1 cargo test -p inpact-bench writes it anew", number + 1);
    }
    assert_eq!(written, page);
}
