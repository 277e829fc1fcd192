//! Room that the adhesive of a press finds in the voids of the wood.

use std::fmt::{self, Display, Formatter};

use particle_file::BitsRef;
use units::Axis;

use crate::open_voids;

/// Two adherends with adhesive between them.
#[derive(Clone, Copy, Debug)]
pub struct Press<'a> {
    /// The bottom and the top adherend, each with the volume of its voxels, m3.
    pub adherends: [(BitsRef<'a>, f64); 2],
    /// Axis across the bond.
    pub normal: Axis,
    /// Bond area, m2.
    pub area_m2: f64,
    /// Distance between the blocks of the adherends in the closed bond, m; negative where they reach into one another.
    pub apart_m: f64,
    /// Volume of the adhesive that stays in the bond, m3.
    pub adhesive_m3: f64,
    /// Axes along which the specimen repeats.
    pub periodic: [bool; 3],
    /// Axes at whose sides adhesive leaves.
    pub open: [bool; 3],
}

/// The voids of the closed bond that adhesive can reach through faces of voxels; air in them and its own compression do not
/// count.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Room {
    /// Their volume over that of the adhesive.
    pub share: f64,
    /// Gap that must remain, m; zero of a bond that can close.
    pub least_gap_m: f64,
}

impl Room {
    /// The room of a press; `None` where adhesive can leave through a side.
    pub fn of(press: &Press) -> Option<Self> {
        let n = press.normal.index();
        if (0..3).any(|axis| axis != n && press.open[axis]) {
            return None;
        }
        let mut room_m3 = press.area_m2 * press.apart_m;
        for ((wood, voxel_m3), is_top) in press.adherends.into_iter().zip([false, true]) {
            let last = wood.dims()[n] - 1;
            let [bond, outer] = if is_top { [0, last] } else { [last, 0] };
            let open = open_voids(wood, press.normal, bond, press.periodic);
            let layers = open.view().counts_along(n);
            if press.open[n] && layers[outer] > 0 {
                return None;
            }
            room_m3 += voxel_m3 * layers.iter().sum::<u64>() as f64;
        }
        let share = room_m3 / press.adhesive_m3;
        let short = (1.0 - share) * press.adhesive_m3 / press.area_m2;
        let least_gap_m = if share < 1.0 - 1e-9 { short } else { 0.0 };
        Some(Self { share, least_gap_m })
    }
}

impl Display for Room {
    /// `room for 62 % of the adhesive: at least 24.5 um of the gap will remain`.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (percent, um) = (100.0 * self.share, 1e6 * self.least_gap_m);
        if um == 0.0 {
            return write!(f, "room for {percent:.0} % of the adhesive");
        }
        let (percent, digits) = (percent.min(99.0), if um < 1.0 { 3 } else { 1 });
        write!(
            f,
            "room for {percent:.0} % of the adhesive: at least {um:.digits$} um of the gap will remain"
        )
    }
}
