//! Names of columns as they stand on axes.

/// A column's name as it stands on an axis: `adhesive.viscosity_Pa_s` as `adhesive.viscosity (Pa s)`.
pub fn worded(column: &str) -> String {
    let known = |unit: &str| match unit {
        "um2" => Some("µm²".to_owned()),
        "um3" => Some("µm³".to_owned()),
        "pa" => Some("Pa".to_owned()),
        "m s" => Some("m/s".to_owned()),
        "cell" => Some("cells".to_owned()),
        "voxel" | "voxels" => Some("voxels".to_owned()),
        unit => units::unit(unit).map(|_| unit.replace("um", "µm")),
    };
    // The longest unit: some hold a blank, which is an underscore here.
    let found = column.match_indices('_').find_map(|(at, _)| {
        let unit = known(&column[at + 1..].replace('_', " "))?;
        Some(format!("{} ({unit})", spaced(&column[..at])))
    });
    found.unwrap_or_else(|| spaced(column))
}

/// The name of a result in words; keys of the case stay as they are written there.
fn spaced(name: &str) -> String {
    if name.contains('.') {
        return name.to_owned();
    }
    let words = name.split('_').map(|word| match word {
        "wp" | "ep" => word.to_uppercase(),
        other => other.to_owned(),
    });
    words.collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_worded_with_their_units() {
        for (column, words) in [
            ("ep_um", "EP (µm)"),
            ("slab_wp_um", "slab WP (µm)"),
            ("adhesive.viscosity_Pa_s", "adhesive.viscosity (Pa s)"),
            ("volume_um3", "volume (µm³)"),
            ("wetted_area_um2", "wetted area (µm²)"),
            ("clamp.max_pressure_MPa", "clamp.max_pressure (MPa)"),
            ("clamp.closing_speed_m_s", "clamp.closing_speed (m/s)"),
            ("integrator.cfl", "integrator.cfl"),
            ("steps", "steps"),
        ] {
            assert_eq!(worded(column), words);
        }
    }
}
