//! Names in texts, and whether they exist.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Folders of the top level whose paths are checked wherever they are named.
const TOP: [&str; 5] = ["lib/", "tools/", "tests/", "docs/", "pipelines/"];
/// Endings of names that are paths of the repository when they hold a slash.
const ENDINGS: [&str; 5] = [".rs", ".md", ".toml", ".mk", ".sh"];
/// Where outputs lie, and what belongs to others.
const ELSEWHERE: [&str; 6] = ["out/", "target/", "/", "~", "http", "$"];

/// A file of the repository and the part of it that is read by people.
pub struct Text {
    /// Path from the root.
    file: String,
    words: String,
}

impl Text {
    /// The text of a document, of the comments of a source file, or all of a tool's source, whose
    /// strings are help.
    pub fn new(file: &str, content: &str) -> Self {
        let comments_only = file.ends_with(".rs") && !file.starts_with("tools/");
        let lines = content.lines().filter_map(|line| {
            let comment = line.find("//").filter(|at| !line[..*at].ends_with(':'));
            match (file.ends_with(".rs"), comment) {
                (true, Some(at)) => Some(line[at..].trim_start_matches(['/', '!'])),
                (true, None) if comments_only => None,
                _ => Some(line),
            }
        });
        Self {
            file: file.to_owned(),
            words: lines.collect::<Vec<_>>().join("\n"),
        }
    }
}

/// Finds what texts name.
pub struct Finder {
    root: PathBuf,
    /// All files, from the root.
    files: BTreeSet<String>,
    targets: BTreeSet<String>,
}

impl Finder {
    pub fn new(root: PathBuf) -> Self {
        let mut files = BTreeSet::new();
        walk(&root, "", &mut files);
        let makes = files
            .iter()
            .filter(|f| *f == "Makefile" || f.ends_with(".mk"));
        let rules: Vec<String> = makes.map(|f| read(&root, f)).collect();
        let targets = (rules.iter().flat_map(|text| text.lines()))
            .filter_map(|line| line.split_once(':'))
            .flat_map(|(names, _)| names.split_whitespace().map(str::to_owned))
            .collect();
        Self {
            root,
            files,
            targets,
        }
    }

    /// All documents, scripts and sources.
    pub fn texts(&self) -> Vec<Text> {
        let own = "tests/documents/";
        (self.files.iter())
            .filter(|f| !f.starts_with(own))
            .filter(|f| {
                [".md", ".rs", ".mk", ".sh"].iter().any(|e| f.ends_with(e)) || *f == "Makefile"
            })
            .map(|f| Text::new(f, &read(&self.root, f)))
            .collect()
    }

    /// Sources whose first line does not say what they hold.
    pub fn unsaid(&self) -> Vec<&str> {
        let says = |f: &str| read(&self.root, f).starts_with("//! ");
        let sources = self.files.iter().filter(|f| f.ends_with(".rs"));
        sources.map(String::as_str).filter(|f| !says(f)).collect()
    }

    /// A sentence about each name in `text` that does not exist.
    pub fn broken(&self, text: &Text) -> Vec<String> {
        let mut said = Vec::new();
        let markdown = text.file.ends_with(".md");
        let words: Vec<&str> = text.words.split_whitespace().collect();
        for (i, word) in words.iter().enumerate() {
            let mut word = *word;
            if let Some((_, link)) = word.split_once("](").filter(|_| markdown) {
                let link = link.split(')').next().unwrap_or_default();
                self.link(&text.file, link, &mut said);
                word = word.split("](").next().unwrap_or_default();
            }
            for name in word.split(|c: char| !(c.is_alphanumeric() || "_./-*#~$:".contains(c))) {
                let name = name
                    .trim_end_matches(['.', ':', '-'])
                    .trim_start_matches([':', '-']);
                self.name(&text.file, name, &mut said);
                let section = (words.get(i + 1).filter(|next| **next == "section"))
                    .and_then(|_| words.get(i + 2));
                if let Some(section) = section.filter(|_| name.ends_with(".md")) {
                    self.section(&text.file, name, section, &mut said);
                }
            }
            if word.trim_start_matches('`') == "make" && word.starts_with('`') && markdown {
                let target = words
                    .get(i + 1)
                    .map_or("", |w| w.trim_matches(['`', ',', '.', ';', ':', ')']));
                let plain = target.chars().all(|c| c.is_ascii_lowercase() || c == '-');
                if plain && !target.is_empty() && !self.targets.contains(target) {
                    said.push(format!("{}: no target `make {target}`", text.file));
                }
            }
        }
        said
    }

    /// A path, or a document with or without a heading.
    fn name(&self, file: &str, name: &str, said: &mut Vec<String>) {
        let (path, heading) = match name.split_once('#') {
            Some((path, heading)) => (path, Some(heading)),
            None => (name, None),
        };
        let checked = TOP
            .iter()
            .any(|top| path.starts_with(top) && path.len() > top.len())
            || path.contains('/') && ENDINGS.iter().any(|e| path.ends_with(e))
            || path.len() > 3 && path.ends_with(".md");
        if !checked || ELSEWHERE.iter().any(|e| path.starts_with(e)) || path.contains([':', '$']) {
            return;
        }
        match (self.find(file, path), heading) {
            (None, _) => said.push(format!("{file}: no {path}")),
            (Some(found), Some(heading)) => self.heading(file, &found, heading, said),
            _ => {}
        }
    }

    fn link(&self, file: &str, link: &str, said: &mut Vec<String>) {
        if link.starts_with("http") || link.starts_with("mailto") {
            return;
        }
        let (path, heading) = link.split_once('#').unwrap_or((link, ""));
        let folder = file.rsplit_once('/').map_or("", |(folder, _)| folder);
        let target = if path.is_empty() {
            Some(file.to_owned())
        } else {
            normal(&format!("{folder}/{path}")).filter(|t| self.exists(t))
        };
        match target {
            None => said.push(format!("{file}: no link target {link}")),
            Some(target) if !heading.is_empty() => self.heading(file, &target, heading, said),
            _ => {}
        }
    }

    fn heading(&self, file: &str, target: &str, heading: &str, said: &mut Vec<String>) {
        let slug = |line: &str| -> String {
            let kept = line.trim().to_lowercase();
            (kept
                .chars()
                .filter(|c| c.is_alphanumeric() || " -_".contains(*c)))
            .map(|c| if c == ' ' { '-' } else { c })
            .collect()
        };
        if !self
            .headings(target)
            .iter()
            .any(|line| slug(line) == heading)
        {
            said.push(format!("{file}: no heading #{heading} in {target}"));
        }
    }

    fn section(&self, file: &str, name: &str, section: &str, said: &mut Vec<String>) {
        let number = section.trim_matches(|c: char| !c.is_ascii_digit());
        let Some(target) = self.find(file, name).filter(|_| !number.is_empty()) else {
            return;
        };
        let headings = self.headings(&target);
        if !headings.iter().any(|line| {
            line.split(' ')
                .next()
                .is_some_and(|n| n.trim_end_matches('.') == number)
        }) {
            said.push(format!("{file}: no section {number} in {target}"));
        }
    }

    /// Headings of a document, without their marks.
    fn headings(&self, document: &str) -> Vec<String> {
        let text = if self.files.contains(document) {
            read(&self.root, document)
        } else {
            String::new()
        };
        (text.lines().filter(|line| line.starts_with('#')))
            .map(|line| line.trim_start_matches('#').trim().to_owned())
            .collect()
    }

    /// The file or folder that a name in `file` means: seen from the root, from a folder above `file`,
    /// or by the end of its path. Parts that stand for any end what is looked for.
    fn find(&self, file: &str, name: &str) -> Option<String> {
        let fixed: Vec<&str> = name.split('/').take_while(|part| !is_any(part)).collect();
        let name = fixed.join("/");
        let folders = file.match_indices('/').map(|(at, _)| &file[..at]).rev();
        let mut places =
            (folders.chain(["", "lib"])).filter_map(|folder| normal(&format!("{folder}/{name}")));
        places.find(|place| self.exists(place)).or_else(|| {
            let ending = format!("/{name}");
            self.files.iter().find(|f| f.ends_with(&ending)).cloned()
        })
    }

    fn exists(&self, path: &str) -> bool {
        let folder = format!("{}/", path.trim_end_matches('/'));
        self.files.contains(path)
            || self
                .files
                .range(folder.clone()..)
                .next()
                .is_some_and(|f| f.starts_with(&folder))
    }
}

/// Whether a part of a path stands for any: it holds a star or a variable, or is in capitals such as
/// `X` or `CASE-SCHEME.toml`.
fn is_any(part: &str) -> bool {
    let stem = part.split('.').next().unwrap_or_default();
    let capitals = stem.chars().all(|c| c.is_ascii_uppercase() || c == '-');
    part.contains(['*', '$']) || capitals && (stem.contains('-') || stem.len() == 1)
}

/// A path without `.` and `..`; none when it leaves the repository.
fn normal(path: &str) -> Option<String> {
    let mut parts: Vec<&str> = Vec::new();
    for part in path.split('/') {
        match part {
            "" | "." => {}
            ".." => {
                parts.pop()?;
            }
            part => parts.push(part),
        }
    }
    Some(parts.join("/"))
}

fn read(root: &Path, file: &str) -> String {
    fs::read_to_string(root.join(file)).unwrap_or_else(|e| panic!("{file}: {e}"))
}

fn walk(root: &Path, folder: &str, files: &mut BTreeSet<String>) {
    for entry in fs::read_dir(root.join(folder)).expect("a folder") {
        let entry = entry.expect("an entry");
        let name = entry.file_name().to_string_lossy().into_owned();
        let path = if folder.is_empty() {
            name.clone()
        } else {
            format!("{folder}/{name}")
        };
        if entry.path().is_dir() {
            if ![".git", "target", "out", "shared"].contains(&name.as_str()) {
                walk(root, &path, files);
            }
        } else {
            files.insert(path);
        }
    }
}
