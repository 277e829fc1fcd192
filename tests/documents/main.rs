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
    let broken: Vec<String> = finder
        .texts()
        .iter()
        .flat_map(|t| finder.broken(t))
        .collect();
    assert!(broken.is_empty(), "\n{}", broken.join("\n"));
}

/// The test above can fail: each of these names something that is not there.
#[test]
fn broken_names_are_found() {
    let finder = Finder::new(root());
    let markdown = |text: &str| finder.broken(&names::Text::new("docs/some.md", text));
    let comment = |text: &str| finder.broken(&names::Text::new("lib/mpm/src/some.rs", text));
    for text in [
        "[a page](nowhere.md)",
        "[a page](methods.md#no-such-heading)",
        "[a heading](#no-such-heading)",
        "as in methods.md section 99.1",
        "see numerics.md for it",
        "`lib/mpm/src/no_such_file.rs`",
        "in `physics/src/no_such_file.rs`",
        "run `pipelines/examples/no-such.sh`",
        "run `make no-such-target`",
    ] {
        assert_eq!(markdown(text).len(), 1, "{text}: {:?}", markdown(text));
    }
    for text in [
        "/// As in docs/results/no-such-page.md.",
        "//! docs/methods.md\n//! section 99",
        "fn f() {} // lib/nowhere/src/lib.rs",
    ] {
        assert_eq!(comment(text).len(), 1, "{text}: {:?}", comment(text));
    }
    for text in [
        "[methods](methods.md#3-the-implicit-scheme), methods.md section 2.6, ../README.md",
        "`lib/mpm/src/step.rs`, `pipelines/cases/*.toml`, `make test`, <https://nowhere.md/a/b.rs>",
    ] {
        assert_eq!(markdown(text), Vec::<String>::new());
    }
    assert_eq!(
        comment("let x = \"docs/nowhere.md\";"),
        Vec::<String>::new()
    );
}

#[test]
fn every_source_opens_with_what_it_holds() {
    assert_eq!(Finder::new(root()).unsaid(), Vec::<&str>::new());
}

#[test]
fn the_book_has_every_document() {
    let root = root();
    let chapters = std::fs::read_to_string(root.join("docs/SUMMARY.md")).unwrap();
    for folder in ["", "results/", "decisions/"] {
        for entry in std::fs::read_dir(root.join("docs").join(folder)).unwrap() {
            let name = entry.unwrap().file_name().into_string().unwrap();
            let is_chapter = name.ends_with(".md") && name != "SUMMARY.md";
            assert!(
                !is_chapter || chapters.contains(&format!("]({folder}{name})")),
                "{folder}{name}"
            );
        }
    }
}
