//! Short vectors whose lanes are fields of one point or node, so that the vector unit is
//! full whatever the number of points in a cell.

use crate::real::Real;

macro_rules! lanes {
    ($name:ident, $n:literal, $align:literal, $doc:literal) => {
        #[doc = $doc]
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[repr(C, align($align))]
        pub(crate) struct $name(pub(crate) [Real; $n]);

        impl $name {
            pub(crate) const ZERO: Self = Self([0.0; $n]);

            /// `self + w x`; fused where `FMA`.
            #[inline(always)]
            pub(crate) fn add_scaled<const FMA: bool>(self, w: Real, x: Self) -> Self {
                self.add_product::<FMA>(Self([w; $n]), x)
            }

            /// `self + a b`, lane by lane; fused where `FMA`.
            #[inline(always)]
            pub(crate) fn add_product<const FMA: bool>(self, a: Self, b: Self) -> Self {
                let mut r = [0.0; $n];
                for l in 0..$n {
                    r[l] = if FMA {
                        a.0[l].mul_add(b.0[l], self.0[l])
                    } else {
                        a.0[l] * b.0[l] + self.0[l]
                    };
                }
                Self(r)
            }

            /// `w self`.
            #[inline(always)]
            pub(crate) fn scaled(self, w: Real) -> Self {
                self.times(Self([w; $n]))
            }

            /// Product lane by lane.
            #[inline(always)]
            pub(crate) fn times(self, b: Self) -> Self {
                let mut r = self.0;
                for l in 0..$n {
                    r[l] *= b.0[l];
                }
                Self(r)
            }
        }
    };
}

lanes!(Lanes8, 8, 32, "Eight lanes.");
lanes!(Lanes4, 4, 16, "Four lanes.");
