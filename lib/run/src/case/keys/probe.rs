//! Keys of the schema, as serde sees it: the check that none is without an entry.

use serde::Deserialize;
use serde::de::value::StrDeserializer;
use serde::de::{self, DeserializeSeed, Deserializer, MapAccess, SeqAccess, Visitor};

use super::{Absent, Key, TABLES};
use crate::case::Case;

/// Follows a path into whatever is read from it and ends there, with "keys" and the names of its keys as
/// error where it is a table.
#[derive(Clone, Copy)]
struct Probe<'a>(&'a [String]);

impl<'de> Deserializer<'de> for Probe<'_> {
    type Error = de::value::Error;

    fn deserialize_any<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Self::Error> {
        Err(de::Error::custom(""))
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Self::Error> {
        visitor.visit_some(self)
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Self::Error> {
        visitor.visit_seq(self)
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Self::Error> {
        match self.0 {
            [] => Err(de::Error::custom(format!("{KEYS}{}", fields.join(" ")))),
            _ => visitor.visit_map(self),
        }
    }

    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 u8 u16 u32 u64 f32 f64 char str string bytes byte_buf unit unit_struct
        newtype_struct tuple tuple_struct map enum identifier ignored_any
    }
}

impl<'de> SeqAccess<'de> for Probe<'_> {
    type Error = de::value::Error;

    fn next_element_seed<T: DeserializeSeed<'de>>(
        &mut self,
        seed: T,
    ) -> Result<Option<T::Value>, Self::Error> {
        seed.deserialize(*self).map(Some)
    }
}

impl<'de> MapAccess<'de> for Probe<'_> {
    type Error = de::value::Error;

    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        seed: K,
    ) -> Result<Option<K::Value>, Self::Error> {
        seed.deserialize(StrDeserializer::new(&self.0[0])).map(Some)
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(
        &mut self,
        seed: V,
    ) -> Result<V::Value, Self::Error> {
        seed.deserialize(Probe(&self.0[1..]))
    }
}

/// Begins the error that lists the keys of a table.
const KEYS: &str = "keys ";

/// Every path of the schema that is no table, below `path`.
fn keys(path: &[String]) -> Vec<String> {
    let found = Case::deserialize(Probe(path)).unwrap_err().to_string();
    let Some(found) = found.strip_prefix(KEYS) else {
        return vec![path.join(".")];
    };
    let below = |name: &str| keys(&[path, &[name.to_owned()]].concat());
    found.split(' ').flat_map(below).collect()
}

fn entries() -> impl Iterator<Item = (String, &'static Key)> {
    TABLES.iter().flat_map(|table| {
        let path = |key: &'static Key| (format!("{}.{}", table.path, key.name), key);
        table.keys.iter().map(path)
    })
}

#[test]
fn every_key_has_an_entry_and_every_entry_a_key() {
    let mut schema = keys(&[]);
    let mut told: Vec<String> = entries().map(|(path, _)| path).collect();
    assert!(schema.len() > 30 && schema.contains(&"clamp.pid.kp".to_owned()));
    schema.sort_unstable();
    told.sort_unstable();
    assert_eq!(
        told, schema,
        "entries of lib/run/src/case/keys (left) against the schema (right)"
    );
    for (path, key) in entries() {
        let whole = key.text.ends_with('.') && !key.text.contains(['|', '\n']);
        assert!(whole, "{path}: sentences in one line, without |");
    }
}

const CASE: &str = r#"
[grid]
cell = "1 um"
[adhesive]
density = "1 g/cm3"
bulk_modulus = "1 GPa"
viscosity = "1 cP"
[contact]
law = "stick"
[clamp]
closing_speed = "1 m/s"
[integrator]
scheme = "explicit"
[[body]]
material = "rigid"
box = { min = ["0 m", "0 m", "0 m"], max = ["1 um", "1 um", "1 um"] }
"#;

/// `CASE` with another value at `path`, parsed.
fn with(path: &str, value: &str) -> Result<Case, crate::case::CaseError> {
    let mut root: toml::Table = CASE.parse().unwrap();
    let value = toml::from_str::<toml::Table>(&format!("v = {value}")).unwrap()["v"].clone();
    let (tables, last) = path.rsplit_once('.').unwrap();
    let mut place = &mut root;
    for name in tables.split('.') {
        let there = place.entry(name).or_insert(toml::Table::new().into());
        let first = match there {
            toml::Value::Array(list) => &mut list[0],
            other => other,
        };
        place = first.as_table_mut().unwrap();
    }
    place.insert(last.into(), value);
    Case::parse(&root.to_string(), std::path::Path::new("c"))
}

/// A quantity that an entry calls a time is one: what the schema wants in place of `true`.
#[test]
fn values_are_of_the_form_told() {
    for (path, key) in entries() {
        let form = (key.form)();
        let said = match with(&path, "true") {
            Err(said) => said.to_string(),
            Ok(_) => {
                assert!(form.contains("`true`"), "{path}: {form}");
                continue;
            }
        };
        let quantity = |name: &&&str| said.contains(&format!("expected {name} as a string"));
        let names = ["a length", "a time", "a speed", "a pressure", "a density"];
        let names = [
            &names[..],
            &["a viscosity", "an acceleration", "a shear rate"],
        ]
        .concat();
        if let Some(name) = names.iter().find(quantity) {
            assert!(
                name.ends_with(&format!(" {form}")),
                "{path}: {form}: {said}"
            );
        }
        if form.starts_with("`\"") && !form.contains(',') {
            assert!(said.contains("string"), "{path}: {said}");
        }
    }
}

/// A default that is told as a value is what a case without the key has.
#[test]
fn defaults_are_those_of_the_schema() {
    let plain = format!(
        "{:?}",
        Case::parse(CASE, std::path::Path::new("c")).unwrap()
    );
    let mut told = 0;
    for (path, key) in entries() {
        let Absent::Value(value) = key.absent else {
            continue;
        };
        let named = with(&path, value).unwrap_or_else(|e| panic!("{path} = {value}: {e}"));
        // What the resolution, not the schema, makes of the absence: the runs of a test of
        // `resolved.toml` are the check.
        if ["velocity", "name", "acceleration"].contains(&key.name) {
            continue;
        }
        assert_eq!(format!("{named:?}"), plain, "{path}");
        told += 1;
    }
    assert!(told >= 7, "{told}");
}
