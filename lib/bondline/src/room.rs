//! Room that the adhesive of a press finds in the voids of the wood.

use std::fmt::{self, Display, Formatter};

use particle_file::BitsRef;
use units::Axis;

use crate::open_voids;

/// Share of the bond's adhesive without room up to which the bond closes: rounding.
const ROUNDING: f64 = 1e-9;

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
    /// Axes at whose sides adhesive can leave.
    pub open: [bool; 3],
}

/// The room of a [`Press`]: the voids of the closed bond that its adhesive can reach through faces of voxels. Neither air in
/// them nor compression of the adhesive counts.
#[derive(Clone, Copy, Debug, PartialEq)]
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
        let excess_m3 = press.adhesive_m3 - room_m3;
        let closes = excess_m3 <= ROUNDING * press.adhesive_m3;
        Some(Self {
            share: room_m3 / press.adhesive_m3,
            least_gap_m: if closes {
                0.0
            } else {
                excess_m3 / press.area_m2
            },
        })
    }

    /// Whether the bond can close.
    pub fn closes(&self) -> bool {
        self.least_gap_m == 0.0
    }
}

impl Display for Room {
    /// `room for 62 % of the adhesive: at least 24.5 um of the gap will remain`.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let percent = 100.0 * self.share;
        if self.closes() {
            return write!(f, "room for {percent:.0} % of the adhesive");
        }
        // Never 100 %, nor no gap.
        let shown =
            |value: f64, digits: [f64; 3]| digits.iter().filter(|&&from| value < from).count();
        let (of_share, um) = (
            shown(100.0 - percent, [0.5, 0.05, 0.005]),
            1e6 * self.least_gap_m,
        );
        let of_gap = 1 + shown(um, [0.95, 0.095, 0.0095]);
        write!(
            f,
            "room for {percent:.of_share$} % of the adhesive: at least {um:.of_gap$} um of the gap will remain"
        )
    }
}

#[cfg(test)]
mod tests {
    use particle_file::BitGrid;

    use super::*;

    /// Wood 8 x 10 x 4 voxels, 2 x 1 x 1 m each, its bond surface above: a lumen of 6 layers at x = 1, and one at x = 7 that
    /// is shut above and below and opens only to the side.
    fn bottom() -> BitGrid {
        BitGrid::from_fn([8, 10, 4], |x, y, _| {
            !(x == 1 && y >= 4 || x == 7 && (3..8).contains(&y))
        })
    }

    /// The same turned over, with a lumen at x = 0 from end to end.
    fn top() -> BitGrid {
        let bottom = bottom();
        BitGrid::from_fn([8, 10, 4], |x, y, z| x > 0 && bottom.get(x, 9 - y, z))
    }

    fn room(adhesive_m3: f64, apart_m: f64, periodic: bool, open: [bool; 3]) -> Option<Room> {
        let wood = [bottom(), top()];
        Room::of(&Press {
            adherends: [0, 1].map(|i| (wood[i].view(), 2.0)),
            normal: Axis::Y,
            area_m2: 64.0,
            apart_m,
            adhesive_m3,
            periodic: [periodic, false, false],
            open,
        })
    }

    /// 48 + 48 + 80 m3 of lumens, and the gap between the blocks.
    #[test]
    fn sealed_lumens_hold_no_adhesive_and_what_has_no_room_stays_in_the_gap() {
        let closed = [false; 3];
        let told = |adhesive, apart, periodic, open| {
            let room = room(adhesive, apart, periodic, open).unwrap();
            (room.share, room.least_gap_m)
        };
        assert_eq!(told(352.0, 0.0, false, closed), (0.5, 2.75));
        assert_eq!(told(176.0, 0.0, false, closed), (1.0, 0.0));
        assert_eq!(told(88.0, 0.0, false, closed), (2.0, 0.0));
        // A layer between the blocks, and a layer by which they reach into one another.
        assert_eq!(told(480.0, 1.0, false, closed), (0.5, 3.75));
        assert_eq!(told(224.0, -1.0, false, closed), (0.5, 1.75));
        // The lumen at x = 0 of the top leads to that at x = 7: 40 m3. That of the bottom stays shut.
        assert_eq!(told(432.0, 0.0, true, closed), (0.5, 3.375));
        for open in [
            [true, false, false],
            [false, false, true],
            [false, true, false],
        ] {
            assert_eq!(room(352.0, 0.0, false, open), None);
        }
    }

    #[test]
    fn the_sentence_never_says_that_all_fits_where_it_does_not() {
        for (share, least_gap_m, said) in [
            (2.3, 0.0, "room for 230 % of the adhesive"),
            (
                0.6153,
                24.546e-6,
                "room for 62 % of the adhesive: at least 24.5 um of the gap will remain",
            ),
            (
                0.9962,
                2.4e-7,
                "room for 99.6 % of the adhesive: at least 0.24 um of the gap will remain",
            ),
            (
                0.0,
                1.2e-4,
                "room for 0 % of the adhesive: at least 120.0 um of the gap will remain",
            ),
        ] {
            assert_eq!(Room { share, least_gap_m }.to_string(), said);
        }
    }
}
