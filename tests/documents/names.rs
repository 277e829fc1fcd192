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

/// The part of a file that people read: all of a document, the comments of a source, all of a tool's source,
/// whose strings are help.
fn readable(file: &str, content: &str) -> String {
    let source = file.ends_with(".rs");
    let strings = file.starts_with("tools/");
    let lines = content.lines().filter_map(|line| {
        let comment = line.find("//").filter(|at| !line[..*at].ends_with(':'));
        match comment.filter(|_| source) {
            Some(at) => Some(line[at..].trim_start_matches(['/', '!'])),
            None if source && !strings => None,
            None => Some(line),
        }
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// Finds what texts name.
pub struct Finder {
    root: PathBuf,
    /// All files, from the root.
    files: BTreeSet<String>,
    /// Targets of make.
    targets: BTreeSet<String>,
}

impl Finder {
    pub fn new(root: PathBuf) -> Self {
        let mut files = BTreeSet::new();
        walk(&root, "", &mut files);
        let is_rules = |f: &&String| *f == "Makefile" || f.ends_with(".mk");
        let rules: String = (files.iter().filter(is_rules))
            .map(|f| read(&root, f))
            .collect();
        let targets = (rules.lines().filter_map(|line| line.split_once(':')))
            .flat_map(|(names, _)| names.split_whitespace().map(str::to_owned))
            .collect();
        Self {
            root,
            files,
            targets,
        }
    }

    /// A sentence about each name in the repository's documents, scripts and sources that does not exist.
    pub fn all_broken(&self) -> Vec<String> {
        let is_text = |file: &&String| {
            let ending = [".md", ".rs", ".mk", ".sh", "Makefile"]
                .iter()
                .any(|e| file.ends_with(e));
            ending && !file.starts_with("tests/documents/")
        };
        let texts = self.files.iter().filter(is_text);
        texts
            .flat_map(|file| self.broken(file, &read(&self.root, file)))
            .collect()
    }

    /// Sources whose first line does not say what they hold.
    pub fn unsaid(&self) -> Vec<&String> {
        let says = |f: &str| read(&self.root, f).starts_with("//! ");
        self.files
            .iter()
            .filter(|f| f.ends_with(".rs") && !says(f))
            .collect()
    }

    /// A sentence about each name in a file that does not exist.
    pub fn broken(&self, file: &str, content: &str) -> Vec<String> {
        let mut said = Vec::new();
        let markdown = file.ends_with(".md");
        let text = readable(file, content);
        let words: Vec<&str> = text.split_whitespace().collect();
        let word = |i: usize| words.get(i).copied().unwrap_or_default();
        for i in 0..words.len() {
            let mut named = word(i);
            if let Some((before, link)) = named.split_once("](").filter(|_| markdown) {
                said.extend(self.link(file, link.split(')').next().unwrap_or_default()));
                named = before;
            }
            for name in named.split(|c: char| !(c.is_alphanumeric() || "_./-*#~$:".contains(c))) {
                let name = name
                    .trim_end_matches(['.', ':', '-'])
                    .trim_start_matches([':', '-']);
                said.extend(self.name(file, name));
                if name.ends_with(".md") && word(i + 1) == "section" {
                    said.extend(self.section(file, name, word(i + 2)));
                }
            }
            let target = word(i + 1).trim_matches(['`', ',', '.', ';', ':', ')']);
            let plain = target.chars().all(|c| c.is_ascii_lowercase() || c == '-');
            let made = markdown && named == "`make" && plain && !target.is_empty();
            if made && !self.targets.contains(target) {
                said.push(format!("{file}: no target `make {target}`"));
            }
        }
        said
    }

    /// A path, or a document with or without a heading.
    fn name(&self, file: &str, name: &str) -> Option<String> {
        let (path, heading) = name.split_once('#').unwrap_or((name, ""));
        let checked = TOP
            .iter()
            .any(|top| path.starts_with(top) && path.len() > top.len())
            || path.contains('/') && ENDINGS.iter().any(|e| path.ends_with(e))
            || path.len() > 3 && path.ends_with(".md");
        let elsewhere = ELSEWHERE.iter().any(|e| path.starts_with(e)) || path.contains([':', '$']);
        if !checked || elsewhere {
            return None;
        }
        match self.find(file, path) {
            None => Some(format!("{file}: no {path}")),
            Some(found) => self.heading(file, &found, heading),
        }
    }

    fn link(&self, file: &str, link: &str) -> Option<String> {
        if link.starts_with("http") || link.starts_with("mailto") {
            return None;
        }
        let (path, heading) = link.split_once('#').unwrap_or((link, ""));
        let folder = file.rsplit_once('/').map_or("", |(folder, _)| folder);
        let target = match path {
            "" => Some(file.to_owned()),
            path => normal(&format!("{folder}/{path}")).filter(|t| self.exists(t)),
        };
        match target {
            None => Some(format!("{file}: no link target {link}")),
            Some(target) => self.heading(file, &target, heading),
        }
    }

    /// A heading by its anchor, if one is given.
    fn heading(&self, file: &str, target: &str, anchor: &str) -> Option<String> {
        let is_anchor = |line: &String| {
            let kept = |c: &char| c.is_alphanumeric() || " -_".contains(*c);
            let line: String = line.to_lowercase().chars().filter(kept).collect();
            line.replace(' ', "-") == anchor
        };
        let missing = !anchor.is_empty() && !self.headings(target).iter().any(is_anchor);
        missing.then(|| format!("{file}: no heading #{anchor} in {target}"))
    }

    /// A section by its number.
    fn section(&self, file: &str, name: &str, section: &str) -> Option<String> {
        let number = section.trim_matches(|c: char| !c.is_ascii_digit());
        let target = self.find(file, name).filter(|_| !number.is_empty())?;
        let first = |line: &String| {
            line.split(' ')
                .next()
                .map(|n| n.trim_end_matches('.') == number)
        };
        let found = self
            .headings(&target)
            .iter()
            .any(|line| first(line) == Some(true));
        (!found).then(|| format!("{file}: no section {number} in {target}"))
    }

    /// Headings of a document, without their marks.
    fn headings(&self, document: &str) -> Vec<String> {
        let text = match self.files.contains(document) {
            true => read(&self.root, document),
            false => String::new(),
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
        let first = self.files.range(folder.clone()..).next();
        self.files.contains(path) || first.is_some_and(|f| f.starts_with(&folder))
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
        let path = Path::new(folder).join(&name).display().to_string();
        if !entry.path().is_dir() {
            files.insert(path);
        } else if ![".git", "target", "out", "shared"].contains(&name.as_str()) {
            walk(root, &path, files);
        }
    }
}
