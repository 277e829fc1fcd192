//! Values of arguments.

use std::ffi::OsStr;
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use clap::ValueEnum;
use clap::builder::{OsStringValueParser, TypedValueParser};
use cli::Output;
use figures::{Case, Colouring, Labelled, Page, Position};
use units::{Length, Pressure, Quantity};

/// How to colour the adhesive.
#[derive(Clone, Copy, ValueEnum)]
pub(crate) enum Colour {
    Plain,
    Pressure,
}

impl From<Colour> for Colouring {
    fn from(colour: Colour) -> Self {
        match colour {
            Colour::Plain => Self::Plain,
            Colour::Pressure => Self::Pressure,
        }
    }
}

/// How much of the wood is shown.
#[derive(Clone, Copy, ValueEnum)]
pub(crate) enum Wood {
    Hidden,
    Cut,
    Whole,
}

impl From<Wood> for figures::Wood {
    fn from(wood: Wood) -> Self {
        match wood {
            Wood::Hidden => Self::Hidden,
            Wood::Cut => Self::Cut,
            Wood::Whole => Self::Whole,
        }
    }
}

/// What of penetration is shown.
#[derive(Clone, Copy, ValueEnum)]
pub(crate) enum Shown {
    Depth,
    Wetted,
    Filled,
}

impl From<Shown> for figures::Shown {
    fn from(shown: Shown) -> Self {
        match shown {
            Shown::Depth => Self::Depth,
            Shown::Wetted => Self::Wetted,
            Shown::Filled => Self::Filled,
        }
    }
}

/// A positive pressure, Pa.
#[derive(Clone, Copy)]
pub(crate) struct Limit(pub(crate) f64);

impl FromStr for Limit {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let pressure = text
            .parse::<Quantity<Pressure>>()
            .and_then(Quantity::positive);
        pressure.map(|p| Self(p.si())).map_err(|e| e.to_string())
    }
}

/// A picture's file and format.
#[derive(Clone)]
pub(crate) struct Target {
    pub(crate) output: Output,
    pub(crate) format: Format,
}

#[derive(Clone, Copy)]
pub(crate) enum Format {
    Svg,
    Png,
    Pdf,
}

impl Target {
    pub(crate) fn new(text: &OsStr) -> Result<Self, String> {
        let output = Output::from(text.to_owned());
        let format = match &output {
            Output::Stdout => Format::Svg,
            Output::File(path) => match path.extension().and_then(|e| e.to_str()) {
                Some(e) if e.eq_ignore_ascii_case("svg") => Format::Svg,
                Some(e) if e.eq_ignore_ascii_case("png") => Format::Png,
                Some(e) if e.eq_ignore_ascii_case("pdf") => Format::Pdf,
                _ => {
                    return Err(format!(
                        "{output} is not a picture's name: it must end in .svg, .png or .pdf"
                    ));
                }
            },
        };
        Ok(Self { output, format })
    }
}

impl Target {
    /// As [`Target::new`], but no standard output.
    pub(crate) fn file(text: &OsStr) -> Result<Self, String> {
        match Self::new(text)? {
            Self {
                output: Output::Stdout,
                ..
            } => Err("a picture of the table goes to a file".into()),
            target => Ok(target),
        }
    }
}

/// Where a PNG goes.
pub(crate) fn png(text: &OsStr) -> Result<Output, String> {
    let png = Path::new(text)
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("png"));
    match png || text == "-" {
        true => Ok(text.to_owned().into()),
        false => Err(format!(
            "{} is no name of a PNG: it must end in .png",
            text.display()
        )),
    }
}

pub(crate) fn name(text: &str) -> Result<(String, String), String> {
    let pair = text
        .split_once('=')
        .filter(|(key, text)| !key.is_empty() && !text.is_empty());
    let pair = pair.map(|(key, text)| (key.to_owned(), text.to_owned()));
    pair.ok_or_else(|| format!("'{text}' is not KEY=TEXT, as in xpic=XPIC(5)"))
}

/// A parser of arguments that hold a path, which need not be UTF-8.
pub(crate) fn given<T: Clone + Send + Sync + 'static>(
    parse: fn(&OsStr) -> Result<T, String>,
) -> impl TypedValueParser<Value = T> {
    OsStringValueParser::new().try_map(move |text| parse(&text))
}

/// What is before and behind the first `=`.
fn name_and_path(text: &OsStr) -> Option<(String, PathBuf)> {
    let bytes = text.as_bytes();
    let at = bytes.iter().position(|b| *b == b'=')?;
    let name = String::from_utf8_lossy(&bytes[..at]).into_owned();
    Some((name, OsStr::from_bytes(&bytes[at + 1..]).into()))
}

/// `LABEL=PATH`, or a path alone, whose last two names are its label.
pub(crate) fn labelled(text: &OsStr) -> Result<Labelled, String> {
    let alone = || (short_name(Path::new(text)), PathBuf::from(text));
    let (label, path) = name_and_path(text).unwrap_or_else(alone);
    if label.is_empty() || path.as_os_str().is_empty() {
        return Err(format!(
            "'{}' needs a label and a path, as in FLIP=out/pf-flip",
            text.display()
        ));
    }
    Ok(Labelled { label, path })
}

/// `xpic/final` for `out/quick/pf/xpic/final.mpts`.
fn short_name(path: &Path) -> String {
    let folder = path.parent().and_then(Path::file_name);
    let names = folder.into_iter().chain(path.file_stem());
    let names: Vec<_> = names.map(|name| name.to_string_lossy()).collect();
    names.join("/")
}

pub(crate) fn experiment(text: &OsStr) -> Result<Case, String> {
    let case = name_and_path(text).map(|(adhesive, path)| Case {
        adhesive,
        name: "experiment".into(),
        path,
    });
    let case = case.ok_or_else(|| {
        let text = text.display();
        format!("'{text}' is not ADHESIVE=CSV, as in pf=experiment.csv")
    })?;
    plain(&case.adhesive)?;
    Ok(case)
}

/// Refuses a name that a spreadsheet would take for a formula.
fn plain(name: &str) -> Result<(), String> {
    match cli::cell(name) == name {
        true => Ok(()),
        false => Err(format!(
            "the name '{name}' would be a formula in a spreadsheet: it may not begin with one of = + - @ ' or have control characters"
        )),
    }
}

pub(crate) fn run(text: &OsStr) -> Result<Case, String> {
    let case = name_and_path(text).and_then(|(of, path)| {
        let (adhesive, name) = of.split_once(':')?;
        Some(Case {
            adhesive: adhesive.into(),
            name: name.into(),
            path,
        })
    });
    let case = case.ok_or_else(|| {
        let text = text.display();
        format!("'{text}' is not ADHESIVE:RUN=CSV, as in pf:xpic=wp.csv")
    })?;
    plain(&case.adhesive).and(plain(&case.name))?;
    Ok(case)
}

/// A printed width, mm.
pub(crate) fn width(text: &str) -> Result<f64, String> {
    let length = text.parse::<Quantity<Length>>();
    let mm = 1e3 * length.map_err(|e| e.to_string())?.si();
    match (Page::NARROWEST..=Page::WIDEST).contains(&mm) {
        true => Ok(mm),
        false => Err(format!(
            "a picture is {} to {} mm wide, not {mm} mm",
            Page::NARROWEST,
            Page::WIDEST
        )),
    }
}

pub(crate) fn degrees(text: &str, [least, most]: [f64; 2]) -> Result<f64, String> {
    match text.parse() {
        Ok(degrees) if (least..=most).contains(&degrees) => Ok(degrees),
        _ => Err(format!(
            "'{text}' is not an angle from {least} to {most} degrees"
        )),
    }
}

pub(crate) fn dpi(text: &str) -> Result<f64, String> {
    let [least, most] = Page::DPI;
    match text.parse() {
        Ok(dpi) if (least..=most).contains(&dpi) => Ok(dpi),
        _ => Err(format!("'{text}' is not a number from {least} to {most}")),
    }
}

/// Frames a second.
pub(crate) fn rate(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(rate) if (0.1..=60.0).contains(&rate) => Ok(rate),
        _ => Err(format!("'{text}' is not a number from 0.1 to 60")),
    }
}

/// A length, or a multiple of the voxel of the first file.
#[derive(Clone, Copy)]
pub(crate) enum Extent {
    Metres(f64),
    Voxels(f64),
}

impl Extent {
    pub(crate) fn si(self, voxel_m: f64) -> f64 {
        match self {
            Self::Metres(length) => length,
            Self::Voxels(n) => n * voxel_m,
        }
    }
}

impl FromStr for Extent {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let text = text.trim();
        let number = text.strip_suffix("voxels").or(text.strip_suffix("voxel"));
        let number = number.and_then(|number| number.trim().parse().ok());
        match number.filter(|n: &f64| n.is_finite()) {
            Some(n) => Ok(Self::Voxels(n)),
            None => (text.parse::<Quantity<Length>>())
                .map(|length| Self::Metres(length.si()))
                .map_err(|e| format!("{e}, or voxels, as in \"2 voxels\"")),
        }
    }
}

/// The edge of a cell.
pub(crate) fn cell(text: &str) -> Result<Extent, String> {
    let cell: Extent = text.parse()?;
    match cell.si(1.0) > 0.0 {
        true => Ok(cell),
        false => Err(format!(
            "a cell of '{text}' is no cell: its edge must be greater than zero"
        )),
    }
}

/// Ends across and up.
pub(crate) type Part = [[Extent; 2]; 2];

pub(crate) fn part(text: &str) -> Result<Part, String> {
    let wrong = || format!("'{text}' is not a part, as in \"0 um:40 um,20 um:60 um\"");
    let range = |text: &str| -> Result<[Extent; 2], String> {
        let (from, to) = text.split_once(':').ok_or_else(wrong)?;
        Ok([from.parse()?, to.parse()?])
    };
    let (across, up) = text.split_once(',').ok_or_else(wrong)?;
    Ok([range(across)?, range(up)?])
}

/// A percentage, as a share.
pub(crate) fn share(text: &str) -> Result<f64, String> {
    match text.strip_suffix('%').unwrap_or(text).trim().parse::<f64>() {
        Ok(percent) if (0.0..=100.0).contains(&percent) => Ok(percent / 100.0),
        _ => Err(format!("'{text}' is not a percentage from 0% to 100%")),
    }
}

pub(crate) fn position(text: &str) -> Result<Position, String> {
    if text.ends_with('%') {
        return share(text).map(Position::Share);
    }
    let length = text.parse::<Quantity<Length>>();
    length
        .map(|length| Position::At(length.si()))
        .map_err(|e| format!("{e}, or a percentage of the box, e.g. 50%"))
}
