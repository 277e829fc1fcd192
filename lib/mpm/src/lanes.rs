//! Short vectors whose lanes are fields of one point or node, or one field of eight points, so that the
//! vector unit is full whatever the number of points in a cell.
//!
//! Operations take `FMA`: with it they are fused, for kernels that `simd` runs where there are such instructions, and in single
//! precision the processor's own on whole vectors (`vector`); else they are plain loops.

#[cfg(all(target_arch = "x86_64", not(feature = "double")))]
mod vector;

use crate::real::Real;

/// Returns what whole vectors give where there are such instructions.
macro_rules! by_vectors {
    ($fma:ident, $given:expr) => {
        #[cfg(all(target_arch = "x86_64", not(feature = "double")))]
        if $fma {
            return $given;
        }
    };
}

/// What sums over points are made of, whatever their number of lanes.
pub(crate) trait Lanes: Copy {
    const ZERO: Self;
    /// Sum lane by lane.
    fn add(self, b: Self) -> Self;
    /// Turns the sign of a lane.
    fn turn(&mut self, lane: usize);
}

macro_rules! lanes {
    ($name:ident, $n:literal, $align:literal, $vector:ident, $doc:literal) => {
        #[doc = $doc]
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[repr(C, align($align))]
        pub(crate) struct $name(pub(crate) [Real; $n]);

        impl Lanes for $name {
            const ZERO: Self = Self::ZERO;

            #[inline(always)]
            fn add(self, b: Self) -> Self {
                self.plus::<false>(b)
            }

            #[inline(always)]
            fn turn(&mut self, lane: usize) {
                self.0[lane] = -self.0[lane];
            }
        }

        impl $name {
            pub(crate) const ZERO: Self = Self([0.0; $n]);

            /// `self + a b`, lane by lane; fused where `FMA`.
            #[inline(always)]
            pub(crate) fn add_product<const FMA: bool>(self, a: Self, b: Self) -> Self {
                by_vectors!(FMA, Self(vector::$vector::fused(a.0, b.0, self.0)));
                let mut r = self.0;
                for l in 0..$n {
                    r[l] = if FMA {
                        a.0[l].mul_add(b.0[l], r[l])
                    } else {
                        r[l] + a.0[l] * b.0[l]
                    };
                }
                Self(r)
            }

            /// `w self`.
            #[inline(always)]
            pub(crate) fn scaled<const FMA: bool>(self, w: Real) -> Self {
                self.times::<FMA>(Self([w; $n]))
            }

            /// Sum lane by lane.
            #[inline(always)]
            pub(crate) fn plus<const FMA: bool>(self, b: Self) -> Self {
                by_vectors!(FMA, Self(vector::$vector::sum(self.0, b.0)));
                let mut r = self.0;
                for l in 0..$n {
                    r[l] += b.0[l];
                }
                Self(r)
            }

            /// Product lane by lane.
            #[inline(always)]
            pub(crate) fn times<const FMA: bool>(self, b: Self) -> Self {
                by_vectors!(FMA, Self(vector::$vector::product(self.0, b.0)));
                let mut r = self.0;
                for l in 0..$n {
                    r[l] *= b.0[l];
                }
                Self(r)
            }

            /// Whether every lane is less than that of `reach` from 0; none that is not a number is.
            #[inline(always)]
            pub(crate) fn is_within(self, reach: Self) -> bool {
                let mut within = true;
                for l in 0..$n {
                    within &= self.0[l].abs() < reach.0[l];
                }
                within
            }
        }
    };
}

lanes!(Lanes8, 8, 32, eight, "Eight lanes.");
lanes!(Lanes4, 4, 16, four, "Four lanes.");

impl Lanes4 {
    /// `self + w x`; fused where `FMA`.
    #[inline(always)]
    pub(crate) fn add_scaled<const FMA: bool>(self, w: Real, x: Self) -> Self {
        self.add_product::<FMA>(Self([w; 4]), x)
    }
}

impl Lanes8 {
    /// Difference lane by lane.
    #[inline(always)]
    pub(crate) fn minus<const FMA: bool>(self, b: Self) -> Self {
        by_vectors!(FMA, Self(vector::difference(self.0, b.0)));
        let mut r = self.0;
        for l in 0..8 {
            r[l] -= b.0[l];
        }
        Self(r)
    }

    /// Two vectors of four beside one another.
    #[inline(always)]
    pub(crate) fn of(low: Lanes4, high: Lanes4) -> Self {
        let ([a, b, c, d], [e, f, g, h]) = (low.0, high.0);
        Self([a, b, c, d, e, f, g, h])
    }

    /// Lanes 0 to 3.
    #[inline(always)]
    pub(crate) fn low(self) -> Lanes4 {
        Lanes4([self.0[0], self.0[1], self.0[2], self.0[3]])
    }

    /// Lanes 4 to 7.
    #[inline(always)]
    pub(crate) fn high(self) -> Lanes4 {
        Lanes4([self.0[4], self.0[5], self.0[6], self.0[7]])
    }

    /// The lanes `from` of these, in that order.
    #[inline(always)]
    pub(crate) fn pick<const FMA: bool>(self, from: [usize; 8]) -> Self {
        by_vectors!(FMA, Self(vector::pick(self.0, from)));
        let mut r = self.0;
        for l in 0..8 {
            r[l] = self.0[from[l]];
        }
        Self(r)
    }
}

/// What eight vectors have in lane 0, 1, 2 and 3.
#[inline(always)]
pub(crate) fn transposed<const FMA: bool>(list: &[Lanes4; 8]) -> [Lanes8; 4] {
    by_vectors!(FMA, {
        let [a, b, c, d, e, f, g, h] = *list;
        let pairs = [
            Lanes8::of(a, e).0,
            Lanes8::of(b, f).0,
            Lanes8::of(c, g).0,
            Lanes8::of(d, h).0,
        ];
        let [x, y, z, u] = vector::transposed(pairs);
        [Lanes8(x), Lanes8(y), Lanes8(z), Lanes8(u)]
    });
    let mut r = [Lanes8::ZERO; 4];
    for (p, x) in list.iter().enumerate() {
        for l in 0..4 {
            r[l].0[p] = x.0[l];
        }
    }
    r
}

/// Eight vectors, or as many as there are and the last one again.
#[inline(always)]
pub(crate) fn first_eight(list: &[Lanes4]) -> [Lanes4; 8] {
    if let Some(eight) = list.first_chunk() {
        return *eight;
    }
    let mut eight = [list[list.len() - 1]; 8];
    for (to, x) in eight.iter_mut().zip(list) {
        *to = *x;
    }
    eight
}

/// Lane 0, 1, ... 7 of all eight vectors.
#[inline(always)]
pub(crate) fn transposed_eight<const FMA: bool>(list: &[Lanes8; 8]) -> [Lanes8; 8] {
    by_vectors!(FMA, {
        let [a, b, c, d, e, f, g, h] = *list;
        let list = [a.0, b.0, c.0, d.0, e.0, f.0, g.0, h.0];
        let [a, b, c, d, e, f, g, h] = vector::transposed_eight(list);
        let ([a, b, c, d], [e, f, g, h]) = ([a, b, c, d].map(Lanes8), [e, f, g, h].map(Lanes8));
        [a, b, c, d, e, f, g, h]
    });
    let mut r = [Lanes8::ZERO; 8];
    for (p, x) in list.iter().enumerate() {
        for l in 0..8 {
            r[l].0[p] = x.0[l];
        }
    }
    r
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::{Kernel, dispatch};

    struct Compare;

    impl Kernel for Compare {
        fn run<const FMA: bool>(self) {
            let list: [Lanes4; 8] = std::array::from_fn(|p| {
                Lanes4(std::array::from_fn(|l| (10 * p + l) as Real + 0.5))
            });
            let wide = transposed::<FMA>(&list);
            assert_eq!(wide, transposed::<false>(&list));
            let from = [7, 0, 3, 3, 1, 6, 2, 5];
            assert_eq!(wide[1].pick::<FMA>(from), wide[1].pick::<false>(from));
            let [a, b, c, d] = wide;
            let eight = [a, b, c, d, d, c, a, b];
            let columns = transposed_eight::<FMA>(&eight);
            assert_eq!(columns, transposed_eight::<false>(&eight));
            assert_eq!(transposed_eight::<false>(&columns), eight);
            // Exact, so that a fused sum is the same.
            assert_eq!(c.add_product::<FMA>(a, b), c.add_product::<false>(a, b));
            assert_eq!(a.minus::<FMA>(b), a.minus::<false>(b));
            assert_eq!(a.plus::<FMA>(b), a.plus::<false>(b));
            assert_eq!(a.times::<FMA>(b), a.times::<false>(b));
            let (x, y) = (a.low(), a.high());
            assert_eq!(x.scaled::<FMA>(0.25), x.scaled::<false>(0.25));
            assert_eq!(Lanes8::of(x, y), a);
        }
    }

    #[test]
    fn whole_vectors_and_loops_give_the_same() {
        dispatch(Compare);
    }
}
