//! The liquid's stress at its points (paper Eqs. 1 and 2), eight points at a time.

use physics::{Liquid, TAIT_C};

use crate::fields::point::J;
use crate::gradient::Gradient;
use crate::lanes::{Lanes8, transposed_eight};
use crate::material::Flow;
use crate::real::{RECIPROCALS, Real, TERMS, exp_m1};
use crate::tiles::Points;
use crate::window::BATCH;

/// The liquid's law with its constants divided by the density.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stress {
    /// C K / rho, m2/s2.
    stiffness: Real,
    /// Largest tension over rho, m2/s2.
    tension: Real,
    /// Largest kinematic viscosity the step is stable with, m2/s.
    pub(crate) cap: Real,
    rate_factor: Real,
    per_cell: Real,
}

impl Stress {
    /// `cell` in m, `cap` the largest viscosity in Pa s.
    pub(crate) fn new(liquid: &Liquid, cell: f64, cap: f64) -> Self {
        Self {
            stiffness: (TAIT_C * liquid.tait.bulk_modulus / liquid.density) as Real,
            tension: liquid
                .cavitation_pressure
                .map_or(Real::INFINITY, |p| (p / liquid.density) as Real),
            cap: (cap / liquid.density) as Real,
            rate_factor: liquid.shear_rate.factor() as Real,
            per_cell: (1.0 / cell) as Real,
        }
    }

    /// Pressure over density at j = J - 1.
    #[inline(always)]
    pub(crate) fn pressure(&self, j: Real) -> Real {
        (self.stiffness * exp_m1(-j * (1.0 / TAIT_C) as Real)).max(-self.tension)
    }

    /// Pressure over density of eight points at their j = J - 1.
    #[inline(always)]
    fn pressures<const FMA: bool>(&self, j: Lanes8) -> Lanes8 {
        let strain = j.scaled::<FMA>(-1.0).scaled::<FMA>((1.0 / TAIT_C) as Real);
        let mut pressure = exp_m1_of_eight::<FMA>(strain).scaled::<FMA>(self.stiffness);
        for p in &mut pressure.0 {
            *p = p.max(-self.tension);
        }
        pressure
    }

    /// Volume change, shear rate and stress of the points after a step of `dt`, from the gradient of velocity
    /// (m/s per cell) at each, eight points at a time.
    #[inline(always)]
    pub(crate) fn update<F: Flow, const FMA: bool>(
        &self,
        points: &mut Points,
        gradient: &Gradient,
        flow: &F,
        dt: Real,
    ) {
        let n = points.len();
        let (motion, stress) = (&mut points.motion[..n], &mut points.stress[..n]);
        let mut start = 0;
        while start < n {
            let end = n.min(start + BATCH);
            let mut j = Lanes8::ZERO;
            for p in start..end {
                j.0[p - start] = motion[p].0[J];
            }
            let slopes = gradient.of_eight(start);
            let (j, new) = self.of_eight::<F, FMA>(&slopes, j, flow, dt);
            for p in start..end {
                motion[p].0[J] = j.0[p - start];
                stress[p] = new[p - start];
            }
            start = end;
        }
    }

    /// j and what `stress` holds of eight points, from their derivatives along x, y, z.
    #[inline(always)]
    fn of_eight<F: Flow, const FMA: bool>(
        &self,
        [x, y, z]: &[[Lanes8; 3]; 3],
        j: Lanes8,
        flow: &F,
        dt: Real,
    ) -> (Lanes8, [Lanes8; BATCH]) {
        let trace = x[0].plus::<FMA>(y[1]).plus::<FMA>(z[2]);
        let trace = trace.scaled::<FMA>(self.per_cell);
        let now = Lanes8([1.0; BATCH]).plus::<FMA>(j);
        let j = j.plus::<FMA>(now.times::<FMA>(trace.scaled::<FMA>(dt)));
        let mut third = trace;
        for third in &mut third.0 {
            *third /= 3.0;
        }
        let mut fields = [
            x[0],
            y[1],
            z[2],
            x[1].plus::<FMA>(y[0]),
            x[2].plus::<FMA>(z[0]),
            y[2].plus::<FMA>(z[1]),
            Lanes8::ZERO,
            Lanes8::ZERO,
        ];
        for a in 0..3 {
            fields[a] = fields[a].scaled::<FMA>(self.per_cell).minus::<FMA>(third);
            fields[3 + a] = fields[3 + a].scaled::<FMA>(0.5 * self.per_cell);
        }
        let sides = squares::<FMA>(&fields[3..6]).scaled::<FMA>(2.0);
        let mut rate = squares::<FMA>(&fields[..3]).plus::<FMA>(sides);
        for rate in &mut rate.0 {
            *rate = rate.sqrt();
        }
        let rate = rate.scaled::<FMA>(self.rate_factor);
        let mut viscosity = rate;
        for viscosity in &mut viscosity.0 {
            *viscosity = flow.viscosity(*viscosity).min(self.cap);
        }
        let (k, p_rho) = (viscosity.scaled::<FMA>(2.0), self.pressures::<FMA>(j));
        for a in 0..3 {
            fields[a] = k.times::<FMA>(fields[a]).minus::<FMA>(p_rho);
            fields[3 + a] = k.times::<FMA>(fields[3 + a]);
        }
        (fields[6], fields[7]) = (rate, viscosity);
        (j, transposed_eight::<FMA>(&fields))
    }
}

#[inline(always)]
fn squares<const FMA: bool>(list: &[Lanes8]) -> Lanes8 {
    let xy = list[0]
        .times::<FMA>(list[0])
        .plus::<FMA>(list[1].times::<FMA>(list[1]));
    xy.plus::<FMA>(list[2].times::<FMA>(list[2]))
}

/// [`exp_m1`] of eight numbers.
#[inline(always)]
fn exp_m1_of_eight<const FMA: bool>(x: Lanes8) -> Lanes8 {
    if !x.is_within(Lanes8([0.25; 8])) {
        let mut each = x;
        for x in &mut each.0 {
            *x = exp_m1(*x);
        }
        return each;
    }
    let mut tail = Lanes8([RECIPROCALS[TERMS]; 8]);
    for k in (2..TERMS).rev() {
        tail = Lanes8([RECIPROCALS[k]; 8]).plus::<FMA>(x.times::<FMA>(tail));
    }
    x.plus::<FMA>(x.times::<FMA>(x).times::<FMA>(tail))
}

#[cfg(test)]
mod tests {
    use physics::{Newtonian, ShearRate, Table, Tait, Viscosity};

    use super::*;
    use crate::lanes::Lanes4;
    use crate::material::{Constant, Segments};
    use crate::simd::{Kernel, dispatch};
    use crate::tiles::Point;

    fn liquid() -> Liquid {
        Liquid {
            density: 1200.0,
            tait: Tait { bulk_modulus: 1e9 },
            viscosity: Viscosity::Newtonian(Newtonian(1.3)),
            shear_rate: ShearRate::Paper,
            cure: None,
            water: None,
            cavitation_pressure: None,
            wetting: None,
        }
    }

    #[test]
    fn tait_pressure_to_rounding() {
        let liquid = liquid();
        let law = Stress::new(&liquid, 2.9e-6, f64::INFINITY);
        let mut worst = 0.0_f64;
        for i in -600..1200 {
            let j = f64::from(i) * 5e-4 + 1e-7;
            let exact = liquid.tait.pressure(f64::from(j as Real));
            worst = worst.max((f64::from(law.pressure(j as Real)) * 1200.0 / exact - 1.0).abs());
            // With others that are near to zero, and with one that is not.
            for beside in [0.0, 0.1] {
                let eight = Lanes8([j as Real, beside, j as Real, 0.0, 0.0, 0.0, 0.0, j as Real]);
                let all = law.pressures::<false>(eight);
                assert_eq!(all.0, eight.0.map(|j| law.pressure(j)));
            }
        }
        println!("largest relative error of the pressure for J in 0.7 to 1.6: {worst:e}");
        assert!(worst < 2e-6);
    }

    /// Points with these j.
    fn points(list: &[Real]) -> Points {
        let mut points = Points::default();
        for &j in list {
            let point = Point {
                id: 0,
                place: Lanes4([0.0, 0.0, 0.0, 0.125]),
                motion: Lanes4([1.0, 2.0, 3.0, j]),
                stress: Lanes8::ZERO,
                affine: [Lanes4::ZERO; 3],
            };
            points.push(&point, 0, false);
        }
        points
    }

    /// Of each point the derivatives along x, y, z of the components.
    fn gradient(list: &[[[Real; 3]; 3]]) -> Gradient {
        let mut gradient = Gradient::default();
        gradient.resize(list.len());
        for (p, along) in list.iter().enumerate() {
            for c in 0..3 {
                gradient.set(p, c, &along.map(|v| Lanes8([v[c]; 8])));
            }
        }
        gradient
    }

    /// Nineteen points by eights against each by itself, j within the series of the exponential and not.
    struct Batches;

    impl Kernel for Batches {
        fn run<const FMA: bool>(self) {
            let law = Stress::new(&liquid(), 2.9e-6, f64::INFINITY);
            let table = Table::new(&[(1.0, 210.0), (1e4, 1.7), (1e6, 1.0)]).unwrap();
            let flow = Segments::new(&table, 1200.0);
            let wave = |i: usize| ((i * 7919 % 1009) as Real / 504.5 - 1.0) * 0.1;
            let j: Vec<Real> = (0..19).map(|p| wave(p) * (1 + p % 4) as Real).collect();
            let slope = |i: usize| [0, 1, 2].map(|l| wave(11 * i + l));
            let slopes = (0..19).map(|p| [0, 1, 2].map(|a| slope(3 * p + a)));
            let slopes: Vec<[[Real; 3]; 3]> = slopes.collect();
            let mut all = points(&j);
            law.update::<_, FMA>(&mut all, &gradient(&slopes), &flow, 1e-9);
            for p in 0..j.len() {
                let mut one = points(&j[p..=p]);
                law.update::<_, FMA>(&mut one, &gradient(&slopes[p..=p]), &flow, 1e-9);
                assert_eq!(one.motion[0], all.motion[p], "{p}");
                assert_eq!(one.stress[0], all.stress[p], "{p}");
                let exact = -law.pressure(one.motion[0].0[J]);
                let mean = one.stress[0].0[..3].iter().sum::<Real>() / 3.0;
                assert!((mean / exact - 1.0).abs() < 1e-4, "{p}: {mean} {exact}");
            }
        }
    }

    #[test]
    fn stresses_of_eight_points_at_once_are_those_of_single_points() {
        dispatch(Batches);
        Batches.run::<false>();
    }

    #[test]
    fn stress_of_compression_and_simple_shear() {
        let liquid = liquid();
        let cell = 2.9e-6;
        let law = Stress::new(&liquid, cell, f64::INFINITY);
        let flow = Constant((1.3 / liquid.density) as Real);
        let mut points = points(&[0.0]);
        let rate = 1e5_f64;
        // dv_x/dy = rate, and a compression that ends at j = -1e-3 after the step.
        let (dt, squeeze) = (1e-9_f64, -1e-3 / 1e-9);
        let mut along = [[0.0; 3]; 3];
        along[1][0] = (rate * cell) as Real;
        along[2][2] = (squeeze * cell) as Real;
        law.update::<_, false>(&mut points, &gradient(&[along]), &flow, dt as Real);
        let s = points.stress[0].0.map(|s| f64::from(s) * 1200.0);
        let p = liquid.tait.pressure(-1e-3);
        let sigma_zz = -p + 2.0 * 1.3 * squeeze * (1.0 - 1.0 / 3.0);
        println!("shear {} Pa, sigma_zz {} of {sigma_zz} Pa", s[3], s[2]);
        assert!((s[3] / (1.3 * rate) - 1.0).abs() < 1e-5);
        assert!((s[2] / sigma_zz - 1.0).abs() < 1e-5);
        assert!((s[0] + s[1] + s[2] + 3.0 * p).abs() < 1e-5 * p.abs() + 50.0);
    }
}
