//! Names in documents, comments and help texts: each exists: documents, links, sections, paths of the
//! repository; and the book has every document.

mod names;

use std::path::{Path, PathBuf};

use names::Finder;

fn root() -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    root.canonicalize().expect("the repository")
}

#[test]
fn every_name_in_documents_and_comments_exists() {
    let finder = Finder::new(root());
    let broken = finder.all_broken();
    assert!(broken.is_empty(), "\n{}", broken.join("\n"));
    assert_eq!(
        finder.unsaid(),
        Vec::<&str>::new(),
        "sources without a line on what they hold"
    );
}

/// The test above can fail: each of these names something that is not there.
#[test]
fn broken_names_are_found() {
    let finder = Finder::new(root());
    let (page, source) = ("docs/some.md", "lib/mpm/src/some.rs");
    for (file, text, broken) in [
        (page, "[a page](nowhere.md)", 1),
        (page, "[a page](methods.md#no-such-heading)", 1),
        (page, "[a heading](#no-such-heading)", 1),
        (page, "as in methods.md section 99.1", 1),
        (page, "see numerics.md for it", 1),
        (page, "`lib/mpm/src/no_such_file.rs`", 1),
        (page, "in `physics/src/no_such_file.rs`", 1),
        (page, "run `pipelines/examples/no-such.sh`", 1),
        (page, "run `make no-such-target`", 1),
        (source, "/// As in docs/results/no-such-page.md.", 1),
        (source, "//! docs/methods.md\n//! section 99", 1),
        (source, "fn f() {} // lib/nowhere/src/lib.rs", 1),
        (
            page,
            "[methods](methods.md#3-the-implicit-scheme), methods.md section 2.6",
            0,
        ),
        (
            page,
            "../README.md, `lib/mpm/src/step.rs`, `pipelines/cases/*.toml`, `make test`",
            0,
        ),
        (page, "<https://nowhere.md/a/b.rs>", 0),
        (source, "let x = \"docs/nowhere.md\";", 0),
    ] {
        let found = finder.broken(file, text);
        assert_eq!(found.len(), broken, "{text}: {found:?}");
    }
}

#[test]
fn the_book_has_every_document_and_pages_of_results_are_filled_in() {
    let docs = root().join("docs");
    let chapters = std::fs::read_to_string(docs.join("SUMMARY.md")).unwrap();
    for folder in ["", "results/", "decisions/"] {
        for entry in std::fs::read_dir(docs.join(folder)).unwrap() {
            let name = entry.unwrap().file_name().into_string().unwrap();
            let is_chapter = name.ends_with(".md") && name != "SUMMARY.md";
            let listed = chapters.contains(&format!("]({folder}{name})"));
            assert!(!is_chapter || listed, "{folder}{name}");
            if is_chapter && folder == "results/" {
                let text = std::fs::read_to_string(docs.join(folder).join(&name)).unwrap();
                let mut words = text.split(|c| !matches!(c, '{' | '}' | '_' | 'a'..='z'));
                let unfilled = words.find(|word| word.starts_with('{') && word.ends_with('}'));
                assert_eq!(unfilled, None, "{name}");
            }
        }
    }
}
