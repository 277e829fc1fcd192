//! Blocks of nodes and what a step does at each node.

use physics::{Rheology, WallLaw};

use crate::contact::{Meeting, Restraint, meeting};
use crate::fields::{body, node, sum, wall_sum};
use crate::lanes::{Lanes, Lanes4, Lanes8};
use crate::lattice::{EDGE, Lattice, block_node};
use crate::real::Real;
use crate::settings::Mode;
use crate::stages::Present;
use crate::tiles::{CellSum, Span, Tile};
use crate::walls::NearBody;

/// Nodes of a block.
const NODES: usize = EDGE * EDGE * EDGE;

/// 4 x 4 x 4 nodes (4 x 4 in plane strain).
#[derive(Clone, Debug)]
pub(crate) struct Block {
    /// Its lowest node.
    pub(crate) origin: [i32; 3],
    /// Where tiles add to its nodes, in the order of the tiles.
    pub(crate) spans: Vec<Span>,
    /// Mirror planes each node lies on, bit per axis.
    planes: Vec<u8>,
    /// v+ and the increment or v*, see `fields.rs`.
    pub(crate) velocity: Vec<Lanes8>,
    /// Bodies near this block, one entry per body; filled before a step.
    pub(crate) walls: Vec<NearBody>,
    /// Impulse on each body in this step, density cell^3 m/s.
    pub(crate) reaction: Vec<[f64; 3]>,
    filter: Filtered,
    /// Sums over cells, at the lowest node of each; empty unless the pressure is a cell's.
    pub(crate) cells: Vec<CellSum>,
}

/// What the velocity filter keeps at nodes; empty without one.
#[derive(Clone, Debug)]
struct Filtered {
    /// w_l of the recursion, and 1 where there is mass.
    w: Vec<Lanes4>,
    /// Empty where no body is near.
    restraints: Vec<Option<Restraint>>,
}

/// What all nodes of a step share.
pub(crate) struct NodeStep<'a, R> {
    pub(crate) law: WallLaw,
    pub(crate) rheology: &'a R,
    /// Velocity of each body, m/s.
    pub(crate) velocities: &'a [[Real; 3]],
    pub(crate) separation: Real,
    /// Gravity times dt, m/s, and nothing beside it.
    pub(crate) fall: [Real; 4],
    /// dt / (rho cell), m2 s/kg per cell^2 of area and unit of mass.
    pub(crate) dt_over_mass: f64,
    pub(crate) mode: Mode,
}

impl Block {
    pub(crate) fn new(key: u64, lattice: &Lattice, bodies: usize, present: Present) -> Self {
        let origin = lattice.tile_origin(key);
        let n = lattice.block_len();
        let planes = (0..n).map(|i| {
            let local = block_node(i);
            lattice.planes(std::array::from_fn(|a| origin[a] + local[a]))
        });
        let filtered = if present.filter { n } else { 0 };
        let filter = Filtered {
            w: vec![Lanes4::ZERO; filtered],
            restraints: Vec::new(),
        };
        Self {
            origin,
            spans: Vec::new(),
            planes: planes.collect(),
            velocity: vec![Lanes8::ZERO; n],
            walls: Vec::with_capacity(bodies),
            reaction: vec![[0.0; 3]; bodies],
            filter,
            cells: vec![[0.0; 2]; if present.cell_mean { n } else { 0 }],
        }
    }

    /// w_l of the filter at the nodes.
    pub(crate) fn filtered(&self) -> &[Lanes4] {
        &self.filter.w
    }

    /// The body of most volume at `node`, if any is there.
    fn body_at(&self, node: usize) -> Option<(usize, &Lanes8)> {
        let mut largest: Option<(usize, &Lanes8)> = None;
        for (body, near) in self.walls.iter().enumerate() {
            let Some(value) = near.values.get(node) else {
                continue;
            };
            if value.0[body::VOLUME] > largest.map_or(1e-6, |(_, v)| v.0[body::VOLUME]) {
                largest = Some((body, value));
            }
        }
        largest
    }

    /// Sums the tiles, applies contact and sides, and updates the momentum of all nodes.
    #[inline(never)] // `make leave-out` counts its instructions by its name
    pub(crate) fn advance<R: Rheology>(&mut self, tiles: &[Tile], step: &NodeStep<R>) {
        self.reaction.fill([0.0; 3]);
        let walls = self.walls.iter().any(|w| w.near != 0);
        let restraints = if walls { self.filter.w.len() } else { 0 };
        if self.filter.restraints.len() != restraints {
            self.filter.restraints = vec![None; restraints];
        }
        let vectors = [sum::MOMENTUM, sum::IMPULSE];
        let sums = sums::<Lanes8, 2>(&self.spans, |t| &tiles[t].local, vectors);
        let near = walls.then(|| {
            let vectors = [wall_sum::MOMENT, wall_sum::GRADIENT];
            self::sums::<Lanes8, 2>(&self.spans, |t| &tiles[t].wall_local, vectors)
        });
        for node in 0..self.velocity.len() {
            let sum = &sums[node];
            let mass = sum.0[sum::MASS];
            if mass <= 0.0 {
                self.velocity[node] = Lanes8::ZERO;
                if let Some(w) = self.filter.w.get_mut(node) {
                    *w = Lanes4::ZERO;
                }
                continue;
            }
            let meeting = near.as_ref().and_then(|near| {
                let (body, rigid) = self.body_at(node)?;
                let liquid = (mass, sum.0[sum::VOLUME], &near[node]);
                let velocity = step.velocities[body];
                let planes = self.planes[node];
                meeting(body, velocity, rigid, liquid, planes, step.separation)
            });
            self.advance_node(node, sum, meeting, step);
        }
    }

    fn advance_node<R: Rheology>(
        &mut self,
        node: usize,
        sum: &Lanes8,
        meeting: Option<Meeting>,
        step: &NodeStep<R>,
    ) {
        let planes = self.planes[node];
        let (momentum, impulse, mass) = (sum.low().0, sum.high().0, sum.0[sum::MASS]);
        // In whole vectors; the fourth lane of the first is 1, that of the second means nothing.
        let raw: [Real; 4] = hold(planes, momentum.map(|p| p / mass));
        let gain: [Real; 4] = std::array::from_fn(|a| impulse[a] / mass + step.fall[a]);
        let [x, y, z, _] = hold(planes, gain);
        let gain = [x, y, z, 0.0];
        // Contact before and after the forces is one decision: were it taken twice, a wall
        // that sticks would let go of the velocity before the forces whenever noise lifts it.
        let touching = meeting.filter(|m| m.holds([0, 1, 2].map(|a| raw[a] + gain[a])));
        let (mut before, mut after) = (raw, std::array::from_fn(|a| raw[a] + gain[a]));
        if let Some(meeting) = &touching {
            before = vector(&raw, |v| meeting.stop_approach(v, step.law));
            before = hold(planes, before);
            let free: [Real; 4] = std::array::from_fn(|a| before[a] + gain[a]);
            let dose = step.dt_over_mass / f64::from(mass);
            after = vector(&free, |v| meeting.resolve(v, step.law, step.rheology, dose));
            after = hold(planes, after);
            let reaction = &mut self.reaction[meeting.body];
            for a in 0..3 {
                let mut impulse = free[a] - after[a];
                if step.mode != Mode::Increment {
                    impulse += raw[a] - before[a];
                }
                reaction[a] += f64::from(mass * impulse);
            }
        }
        let second = match step.mode {
            Mode::Increment => std::array::from_fn(|a| after[a] - before[a]),
            _ => [after[0], after[1], after[2], 0.0],
        };
        self.velocity[node] = Lanes8::of(Lanes4(after), Lanes4(second));
        if matches!(step.mode, Mode::FilterBefore | Mode::FilterAfter) {
            let of_before = step.mode == Mode::FilterBefore;
            self.filter.w[node] = Lanes4(if of_before { before } else { after });
            if let Some(restraint) = self.filter.restraints.get_mut(node) {
                *restraint = touching.map(|meeting| meeting.restraint());
            }
        }
    }

    /// One step of the recursion w_l = (I - S+ S) w_{l-1}, added to v*. The increment of a
    /// body's velocity is zero for l >= 2, so contact only restrains.
    #[inline(never)] // `make leave-out` counts its instructions by its name
    pub(crate) fn refine<R: Rheology>(&mut self, tiles: &[Tile], step: &NodeStep<R>) {
        let sums = sums::<Lanes4, 1>(&self.spans, |t| &tiles[t].filtered, [0]);
        for node in 0..self.velocity.len() {
            if self.filter.w[node].0[node::ONE] == 0.0 {
                continue;
            }
            let (sum, old) = (sums[node].0, self.filter.w[node].0);
            // In whole vectors: in the fourth lane, 1 less a mass over itself, nothing is left.
            let mass = sum[sum::MASS];
            let free: [Real; 4] = std::array::from_fn(|a| old[a] - sum[a] / mass);
            let free = hold(self.planes[node], free);
            let mut w = free;
            if let Some(Some(restraint)) = self.filter.restraints.get(node) {
                let mut restrained = [w[0], w[1], w[2]];
                restraint.restrain(&mut restrained, step.law);
                let [x, y, z] = restrained;
                w = hold(self.planes[node], [x, y, z, 0.0]);
                for (a, r) in self.reaction[restraint.body()].iter_mut().enumerate() {
                    *r += f64::from(mass * (free[a] - w[a]));
                }
            }
            self.filter.w[node] = Lanes4([w[0], w[1], w[2], 1.0]);
            let velocity = &mut self.velocity[node];
            let sum = velocity.high().plus::<false>(Lanes4(w));
            *velocity = Lanes8::of(velocity.low(), sum);
        }
    }
}

/// Sums over the tiles that reach each node; vectors begin at the lanes `vectors`. A tile without values adds
/// nothing.
fn sums<'a, T: Lanes + 'a, const N: usize>(
    spans: &[Span],
    values: impl Fn(usize) -> &'a Vec<T>,
    vectors: [usize; N],
) -> [T; NODES] {
    let mut sums = [T::ZERO; NODES];
    for span in spans {
        let Some(values) = values(span.other as usize).get(span.entries()) else {
            continue;
        };
        let sums = &mut sums[span.nodes()];
        if span.flip == 0 {
            span.each(sums, values, |sum, &value| *sum = sum.add(value));
            continue;
        }
        for (sum, &value) in sums.iter_mut().zip(values) {
            let mut value = value;
            for a in span.mirrored() {
                vectors.iter().for_each(|first| value.turn(first + a));
            }
            *sum = sum.add(value);
        }
    }
    sums
}

/// `v` with its first three lanes as `of` leaves them.
fn vector(v: &[Real; 4], of: impl Fn(&mut [Real; 3])) -> [Real; 4] {
    let mut x = [v[0], v[1], v[2]];
    of(&mut x);
    [x[0], x[1], x[2], v[3]]
}

/// Removes the components normal to the mirror planes of a node.
fn hold<const N: usize>(planes: u8, mut v: [Real; N]) -> [Real; N] {
    if planes != 0 {
        for (a, v) in v.iter_mut().enumerate() {
            if planes & (1 << a) != 0 {
                *v = 0.0;
            }
        }
    }
    v
}
