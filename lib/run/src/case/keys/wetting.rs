//! Keys of surface tension and contact angle.

use units::{Angle, SurfaceTension};

use super::{Absent, Key, quantity};

pub(super) const SURFACE_TENSION: Key = Key {
    name: "surface_tension",
    form: quantity::<SurfaceTension>,
    absent: Absent::Nothing("not used: the liquid's surface pulls nowhere"),
    text: "Surface tension: with `contact_angle` it draws the liquid into lumens, also after the press is released; implicit scheme. 0.03 to 0.07 N/m for wood adhesives.",
};

pub(super) const CONTACT_ANGLE: Key = Key {
    name: "contact_angle",
    form: quantity::<Angle>,
    absent: Absent::Nothing("not used"),
    text: "Contact angle on the cell wall, measured in the liquid: `\"0 deg\"` wets fully, above `\"90 deg\"` lumens keep the liquid out until it is pressed in. Goes with `surface_tension`.",
};

pub(super) const DYNAMIC_ANGLE: Key = Key {
    name: "dynamic_angle",
    form: || "number, at least 0".into(),
    absent: Absent::Nothing("0: the angle does not depend on the speed"),
    text: "k of cos(angle) = cos(`contact_angle`) - k Ca where a front goes by Ca = viscosity x speed/`surface_tension`, between 0 and 180 degrees: what moves its contact line. As much as k/8 of its diameter more length of a tube, k/6 of its width of a slit: without it lumens fill too fast until they are filled many times deeper. Fits to glycerol in glass tubes have 61 to 103; of adhesives on wood none is measured.",
};
