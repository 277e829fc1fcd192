//! Values of arguments.

use std::ffi::OsStr;
use std::path::Path;
use std::str::FromStr;

use clap::builder::{OsStringValueParser, PossibleValuesParser, TypedValueParser};
use cli::Output;
use figures::{Case, Drawing, Error, Labelled, Page, Position};
use strum::VariantNames;
use units::{Length, si};

/// A parser of what has a name.
pub(crate) fn one_of<T>() -> impl TypedValueParser<Value = T>
where
    T: VariantNames + FromStr<Err = strum::ParseError> + Clone + Send + Sync + 'static,
{
    PossibleValuesParser::new(T::VARIANTS).try_map(|name| name.parse())
}

/// A picture's file, and how it is rendered.
#[derive(Clone)]
pub(crate) struct Target {
    pub(crate) output: Output,
    pub(crate) render: Render,
    /// Whether text stays text that the viewer draws.
    pub(crate) keeps_text: bool,
}

type Render = fn(&Drawing) -> Result<Vec<u8>, Error>;

const FORMATS: [(&str, Render); 3] = [
    ("svg", |drawing| drawing.to_svg().map(String::into_bytes)),
    ("png", Drawing::to_png),
    ("pdf", Drawing::to_pdf),
];

impl Target {
    pub(crate) fn new(text: &OsStr) -> Result<Self, String> {
        let output = Output::from(text.to_owned());
        let named = |end: &OsStr| {
            FORMATS
                .iter()
                .find(|(name, _)| end.eq_ignore_ascii_case(name))
        };
        let format = match &output {
            Output::Stdout => Some(&FORMATS[0]),
            Output::File(path) => path.extension().and_then(named),
        };
        let wrong = "is not a picture name: it must end in .svg, .png or .pdf";
        let (name, render) = format.ok_or_else(|| format!("{output} {wrong}"))?;
        let keeps_text = *name == FORMATS[0].0;
        Ok(Self {
            output,
            render: *render,
            keeps_text,
        })
    }

    /// As [`Target::new`], but no standard output.
    pub(crate) fn file(text: &OsStr) -> Result<Self, String> {
        let target = Self::new(text)?;
        match target.output {
            Output::Stdout => Err("a picture of the table goes to a file".into()),
            Output::File(_) => Ok(target),
        }
    }
}

/// Where a PNG goes.
pub(crate) fn png(text: &OsStr) -> Result<Output, String> {
    let extension = Path::new(text).extension();
    match text == "-" || extension.is_some_and(|e| e.eq_ignore_ascii_case("png")) {
        true => Ok(text.to_owned().into()),
        false => Err(format!(
            "{} is not a PNG name: it must end in .png",
            text.display()
        )),
    }
}

pub(crate) fn name(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((key, name)) if !key.is_empty() && !name.is_empty() => Ok((key.into(), name.into())),
        _ => Err(format!("'{text}' is not KEY=TEXT, as in xpic=XPIC(5)")),
    }
}

/// A parser of arguments that hold a path, which need not be UTF-8.
pub(crate) fn given<T: Clone + Send + Sync + 'static>(
    parse: fn(&OsStr) -> Result<T, String>,
) -> impl TypedValueParser<Value = T> {
    OsStringValueParser::new().try_map(move |text| parse(&text))
}

/// `LABEL=PATH`, or a path alone, whose last two names are its label.
pub(crate) fn labelled(text: &OsStr) -> Result<Labelled, String> {
    Labelled::parse(text, short_name)
}

/// `xpic/final` for `out/quick/pf/xpic/final.mpts`.
fn short_name(path: &Path) -> String {
    let folder = path.parent().and_then(Path::file_name);
    let names = folder.into_iter().chain(path.file_stem());
    let names: Vec<_> = names.map(|name| name.to_string_lossy()).collect();
    names.join("/")
}

pub(crate) fn experiment(text: &OsStr) -> Result<Case, String> {
    let example = "ADHESIVE=CSV, as in pf=experiment.csv";
    case(text, example, |adhesive| Some((adhesive, Case::EXPERIMENT)))
}

pub(crate) fn run(text: &OsStr) -> Result<Case, String> {
    let example = "ADHESIVE:RUN=CSV, as in pf:xpic=wp.csv";
    case(text, example, |of| of.split_once(':'))
}

/// `OF=CSV`, with the adhesive and the name that are in `OF`.
fn case(
    text: &OsStr,
    example: &str,
    split: fn(&str) -> Option<(&str, &str)>,
) -> Result<Case, String> {
    let given = Labelled::split(text);
    let case = given.as_ref().and_then(|given| {
        let (adhesive, name) = split(&given.label)?;
        Some(Case {
            adhesive: adhesive.into(),
            name: name.into(),
            path: given.path.clone(),
        })
    });
    let case = case.ok_or_else(|| format!("'{}' is not {example}", text.display()))?;
    plain(&case.adhesive).and(plain(&case.name))?;
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

/// A printed width, mm.
pub(crate) fn width(text: &str) -> Result<f64, String> {
    let mm = 1e3 * si::<Length>(text).map_err(|e| e.to_string())?;
    match (Page::NARROWEST..=Page::WIDEST).contains(&mm) {
        true => Ok(mm),
        false => Err(format!(
            "a picture is {} to {} mm wide, not {mm} mm",
            Page::NARROWEST,
            Page::WIDEST
        )),
    }
}

/// The number in `text`, if it is from `least` to `most`.
fn within([least, most]: [f64; 2], text: &str) -> Option<f64> {
    let number = text.parse().ok();
    number.filter(|number| (least..=most).contains(number))
}

pub(crate) fn degrees(text: &str, [least, most]: [f64; 2]) -> Result<f64, String> {
    let wrong = || format!("'{text}' is not an angle from {least} to {most} degrees");
    within([least, most], text).ok_or_else(wrong)
}

pub(crate) fn number(text: &str, [least, most]: [f64; 2]) -> Result<f64, String> {
    let wrong = || format!("'{text}' is not a number from {least} to {most}");
    within([least, most], text).ok_or_else(wrong)
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
            None => si::<Length>(text)
                .map(Self::Metres)
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
            "'{text}' is not a cell size: it must be greater than zero"
        )),
    }
}

/// Ends of a part across and up.
pub(crate) fn part(text: &str) -> Result<[[Extent; 2]; 2], String> {
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
    let percent = text.strip_suffix('%').unwrap_or(text).trim();
    let share = within([0.0, 100.0], percent).map(|percent| percent / 100.0);
    share.ok_or_else(|| format!("'{text}' is not a percentage from 0% to 100%"))
}

pub(crate) fn position(text: &str) -> Result<Position, String> {
    if text.ends_with('%') {
        return share(text).map(Position::Share);
    }
    let length = si::<Length>(text);
    length
        .map(Position::At)
        .map_err(|e| format!("{e}, or a percentage of the box, e.g. 50%"))
}
