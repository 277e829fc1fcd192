//! Saving and restoring: points in their order in memory, so that sums keep theirs.

use physics::restored;
use physics::{Array, Motion, Pieces, Saved, Saving};

use crate::explicit::{Corrections, Explicit, State};
use crate::fields::point::{J, VOLUME};
use crate::lanes::{Lanes4, Lanes8};
use crate::real::{self, Real};
use crate::tiles::{Point, Points, Tile};
use crate::topology::Grid;

/// Integers of [`State`] in the array "counts", two words each: step, lost, stopped, trapped.
fn words(counts: [u64; 4]) -> Vec<u32> {
    counts
        .iter()
        .flat_map(|&c| [c as u32, (c >> 32) as u32])
        .collect()
}

impl Explicit {
    pub(crate) fn to_saving(&self) -> Vec<(String, Saving<'_>)> {
        let state = &self.state;
        let control = self.control.as_ref().map_or([0.0; 3], |c| c.state());
        let mut clock = vec![state.time_s, state.travel_m, state.limit_s];
        clock.extend(control);
        let corrections = state.corrections;
        let counts = [
            state.step,
            state.lost,
            corrections.stopped,
            corrections.trapped,
        ];
        let displacement = state.displacement.iter().flatten().copied().collect();
        let whole = Saving::Whole;
        let node = |tile: &Tile| {
            let nodes = tile.points.base.iter().map(|&base| tile.node_of(base));
            nodes.flatten().map(|n| n as u32).collect()
        };
        let mut arrays = vec![
            (
                "id",
                Saving::U32(self.by_tile(|tile| tile.points.id.clone())),
            ),
            ("node", Saving::U32(self.by_tile(node))),
            (
                "place",
                self.reals(|points| points.place.iter().flat_map(|q| q.0)),
            ),
            (
                "motion",
                self.reals(|points| points.motion.iter().flat_map(|q| q.0)),
            ),
            (
                "stress",
                self.reals(|points| points.stress.iter().flat_map(|o| o.0)),
            ),
            ("clock", whole(Array::F64(clock))),
            ("counts", whole(Array::U32(words(counts)))),
            ("displacement", whole(Array::F64(displacement))),
        ];
        if self.present.affine {
            let affine = self.reals(|points| points.affine.iter().flatten().flat_map(|q| q.0));
            arrays.push(("affine", affine));
        }
        if let Some(projection) = &self.projection {
            arrays.push(("projection", whole(Array::F64(projection.state()))));
        }
        let named = arrays.into_iter();
        named
            .map(|(name, array)| (name.to_owned(), array))
            .collect()
    }

    /// What `of` makes of each tile, one after the other.
    fn by_tile<'a, T>(&'a self, of: impl Fn(&'a Tile) -> Vec<T> + 'a) -> Pieces<'a, T> {
        Box::new(move |take| self.grid.tiles.iter().for_each(|tile| take(&of(tile))))
    }

    /// Numbers of all points.
    fn reals<'a, I: Iterator<Item = Real>>(
        &'a self,
        of: impl Fn(&'a Points) -> I + 'a,
    ) -> Saving<'a> {
        real::saving(self.by_tile(move |tile| of(&tile.points).collect()))
    }

    pub(crate) fn take_saved(&mut self, saved: &Saved) -> Result<(), String> {
        let clock = sized(saved.f64s("clock")?, 6, "clock")?;
        let counts = sized(saved.u32s("counts")?, 8, "counts")?;
        let bodies = self.scene.bodies.len();
        let displacement = sized(saved.f64s("displacement")?, 3 * bodies, "displacement")?;
        let count = |i: usize| u64::from(counts[2 * i]) | u64::from(counts[2 * i + 1]) << 32;
        self.check_saved(saved, clock, count(1), displacement)?;
        self.state = State {
            step: count(0),
            time_s: clock[0],
            travel_m: clock[1],
            limit_s: clock[2],
            displacement: displacement
                .chunks_exact(3)
                .map(|d| [d[0], d[1], d[2]])
                .collect(),
            lost: count(1),
            corrections: Corrections {
                stopped: count(2),
                trapped: count(3),
            },
        };
        if let Some(control) = &mut self.control {
            control.set_state([clock[3], clock[4], clock[5]]);
        }
        if let Some(projection) = &mut self.projection {
            let state = sized(saved.f64s("projection")?, 3, "projection")?;
            restored::check_finite(state, "projection")?;
            projection.set_state([state[0], state[1], state[2]]);
        }
        // Checked above, all of them.
        let points = self.saved_points(saved)?.flatten();
        self.grid = Grid::like(&self.grid);
        self.grid.insert(points);
        Ok(())
    }

    /// Refuses what no run of this scene saves.
    fn check_saved(
        &self,
        saved: &Saved,
        clock: &[f64],
        lost: u64,
        displacement: &[f64],
    ) -> Result<(), String> {
        let present = || self.grid.tiles.iter().flat_map(|tile| &tile.points.place);
        let total = present().count() + self.state.lost as usize;
        restored::check_points(saved.u32s("id")?, total, lost)?;
        let most = present().map(|place| place.0[VOLUME]).fold(0.0, Real::max);
        for saved in self.saved_points(saved)? {
            let (at, point) = saved?;
            self.check_point(at, &point, most)?;
        }
        restored::check_finite(clock, "clock")?;
        restored::check_travel(&self.scene, clock[1])?;
        let motions: Vec<Motion> = self.scene.bodies.iter().map(|body| body.motion).collect();
        let displacement = displacement.as_chunks().0;
        let cell = self.scene.grid.cell_m;
        restored::check_bodies(&motions, displacement, clock[1], cell)?;
        let (shortest, longest) = self.limits_s();
        let speed = self.scene.clamp.map_or(0.0, |clamp| clamp.closing_speed);
        if clock[0] < 0.0
            || !(shortest..=longest).contains(&clock[2])
            || !(0.0..=speed).contains(&clock[5])
        {
            return Err(format!(
                "the clock of the checkpoint, {clock:?}, is not that of a run: its step limit must be from {shortest:e} to {longest:e} s and its closing speed from 0 to {speed} m/s"
            ));
        }
        Ok(())
    }

    /// Refuses a point that is beside its node, has no volume, or values that are no numbers.
    fn check_point(&self, at: [i32; 3], point: &Point, most: Real) -> Result<(), String> {
        /// Rounding of an offset of half a cell.
        const HALF: Real = 0.5001;
        let lattice = &self.grid.lattice;
        let place = point.place.0;
        let axes = lattice.axes();
        let near = (0..3).all(|a| place[a].abs() <= if a < axes { HALF } else { 1.0 });
        let home = lattice
            .fold(at)
            .is_some_and(|folded| folded.node == at && folded.flip == 0);
        let fits = home && near && (axes == 3 || at[2] == 0);
        // A point alone may be anything that a step can make of it, but not nothing.
        let volume = place[VOLUME] > 0.0 && place[VOLUME] <= most && point.motion.0[J] > -1.0;
        let affine = point.affine.iter().flat_map(|q| q.0);
        let mut values = (point.motion.0.into_iter())
            .chain(point.stress.0)
            .chain(affine);
        match fits && volume && values.all(Real::is_finite) {
            true => Ok(()),
            false => Err(format!(
                "point {} of the checkpoint cannot be: it is at node {at:?} with {place:?}, and moves by {:?}",
                point.id, point.motion.0
            )),
        }
    }

    /// The points with their nodes, one by one.
    fn saved_points<'a>(
        &self,
        saved: &'a Saved,
    ) -> Result<impl Iterator<Item = Result<([i32; 3], Point), String>> + use<'a>, String> {
        let id = saved.u32s("id")?;
        let n = id.len();
        let node = sized(saved.u32s("node")?, 3 * n, "node")?;
        let place = sized(real::saved(saved, "place")?, 4 * n, "place")?;
        let motion = sized(real::saved(saved, "motion")?, 4 * n, "motion")?;
        let stress = sized(real::saved(saved, "stress")?, 8 * n, "stress")?;
        let affine = if self.present.affine {
            sized(real::saved(saved, "affine")?, 12 * n, "affine")?
        } else {
            &[]
        };
        let quad = |a: &[Real], i: usize| Lanes4([a[i], a[i + 1], a[i + 2], a[i + 3]]);
        let cells = self.grid.lattice.cells;
        Ok((0..n).map(move |p| {
            let at: [i32; 3] = std::array::from_fn(|a| node[3 * p + a] as i32);
            if (0..3).any(|a| !(0..=cells[a]).contains(&at[a])) {
                return Err(format!(
                    "point {p} of the checkpoint is at node {at:?} of a grid of {cells:?} cells"
                ));
            }
            let point = Point {
                id: id[p],
                place: quad(place, 4 * p),
                motion: quad(motion, 4 * p),
                stress: Lanes8(std::array::from_fn(|l| stress[8 * p + l])),
                affine: std::array::from_fn(|a| {
                    if affine.is_empty() {
                        Lanes4::ZERO
                    } else {
                        quad(affine, 12 * p + 4 * a)
                    }
                }),
            };
            Ok((at, point))
        }))
    }
}

/// `array` if it has `len` entries.
fn sized<'a, T>(array: &'a [T], len: usize, name: &str) -> Result<&'a [T], String> {
    if array.len() == len {
        Ok(array)
    } else {
        Err(format!(
            "array '{name}' of the checkpoint has {} entries, but this scene needs {len}",
            array.len()
        ))
    }
}
