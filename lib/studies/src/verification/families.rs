//! Texts of the verification page on each family of scenes.

/// Heading and text of each family, in the order of the page.
pub(super) const FAMILIES: &[(&str, &str)] = &[
    (
        "incline",
        "Film on an incline (paper Eq. 5, Fig. 4)\n\nGravity of the earth, 50 degrees; 0.5 ms at 6 cells with the floor on the nodes as in the paper, 0.05 ms elsewhere (the film is steady after 1 us).\n\n![Profiles at 0.5 ms, floor on the nodes](verification-incline.png)\n![Points at 0.5 ms coloured by velocity](verification-incline-points.png)",
    ),
    (
        "channel",
        "Channel (plane Poiseuille), with and without slip\n\nMean velocity against that of rho g (y (H - y) + H l)/(2 eta) at the points' own places.\n\n![Error over the offset of the walls, 6 cells](verification-channel.png)",
    ),
    (
        "table",
        "Viscosity table in a channel\n\nEta linear in log10 of the rate, 20 to 5 Pa s; mean velocity against quadrature of the profile at the points' places. Noise of FLIP's velocities counts as shear and thins the liquid.",
    ),
    (
        "law",
        "Laws by formula in a channel\n\nPower law (n = 0.5, 0.3), Cross, Carreau and Herschel-Bulkley, shear rates up to 3e4 1/s: mean velocity against quadrature of the profile at the points' places, that of Herschel and Bulkley's own law, not of its regularised form. Motion within the plug: how far velocities differ where the stress is below the yield stress, a cell within, over the velocity there.",
    ),
    (
        "couette",
        "Couette flow with partial slip\n\nSlip velocity at the resting wall, from a line through the middle half of the gap: an error of 1 % in its slope is one of 5 % here. The stress, by Eq. 3 the slip velocity times eta/l, follows from the power dissipated too (of which the explicit scheme's leaves out the friction at walls). In the implicit scheme it is too large by 2/(3 n (n + 2 l)), l in cells, since walls act at the distance that is exact for Poiseuille flow (docs/methods.md section 3.5).",
    ),
    (
        "duct",
        "Lumens in three dimensions\n\nDeveloped flow through a square and a tube of voxels (tube: two voxels on the edge of a cell, tube1: one); 7 cells put the walls half a cell off. The mean is over the points, whose places make it up to 1/(4 n^2) too large. The staircase itself slows the flow by 9 % against a circle of the same area: the second row of a tube compares with finite differences in the same staircase.",
    ),
    (
        "slit",
        "A piston presses liquid into a slit\n\nForce on the piston at four filled lengths against finite elements behind a tracked front (lib/studies/reference), the piston's corners as sharp as a cell; density is the volume of the points in the reservoir over the room there, minus one.\n\n![Force over filled length, 6 cells, walls on the nodes](verification-slit.png)",
    ),
    (
        "piston",
        "A piston presses liquid into a square lumen and a tube\n\nPressure against developed flow (finite differences in the same staircase) plus the equivalent length of front and entrance: the front's by finite elements behind a tracked front (lib/studies/reference), the flat entrance's by the implicit scheme in finer cells.",
    ),
    (
        "washburn",
        "Filling a slit at constant pressure\n\nTime to five widths against finite elements behind a tracked front (lib/studies/reference), the piston's corners as sharp as a cell; the error of L(t) is half that of the time.",
    ),
    (
        "washburn3d",
        "Filling a square lumen and a tube at constant pressure\n\nTime from one to two diameters, as for the piston.",
    ),
    (
        "cure",
        "Filling at constant pressure with an adhesive that cures\n\nGel-time law (1 - t/t_gel)^-2, and a viscosity that grows 1e6-fold exponentially: filled length L against L (L + 2 e) = (r^2/4) integral of P/eta dt in a tube ((H^2/6) in a slit), e the equivalent length of entrance and front as for washburn. The run ends by itself where the viscosity is 1e6 times that at the start.",
    ),
    (
        "water",
        "Filling at constant pressure with loss of water\n\nThe lumen's walls take water at a constant rate per area; the viscosity grows 1e3-fold from 45 to 75 % solids, and the front of a column of five widths stops after three: filled length L against Darcy's law and the balance of solids and water along the lumen, well mixed over its section, the contact line behind the front as far as by finite elements (lib/studies/src/verification/water_front.rs). Mass of water: what is neither in the points nor in the walls at the end, over all of it.",
    ),
    (
        "wicking",
        "Slits and tubes draw liquid in, or keep it out\n\nSurface tension 0.05 N/m: filled length L from one width on against L (L + 2 e) = H sigma cos(theta) t/(3 eta) in a slit and r sigma cos(theta) t/(2 eta) in a tube (resistance of its own staircase), e the equivalent length of entrance and front as for washburn; at 120 degrees the length entered. Offsets of the walls across and along the slit, cells.",
    ),
    (
        "jurin",
        "Capillary rise\n\nPlates with a slit between them dip into a pool under a body force: height of the liquid between over that beside them at rest, against 2 sigma cos(theta)/(rho g H), the menisci beside them counted.",
    ),
    (
        "air",
        "Filling a slit with a closed end\n\nAt constant pressure, 4 p_0 above p_0, eight widths long: filled length by the piston's travel against (L + e) dL/dt = (H^2/12 eta) (P - p_0 (m/(L_0 - L) - 1)), m = L_0, to L_0 P/(P + p_0) in the end (Boyle); e is the equivalent length of entrance and front as for washburn. With a leak dm/dt = -(m/(L_0 - L) - 1) (L_0 - L)/t_leak beside it.",
    ),
    (
        "spheres",
        "A simple cubic array of spheres\n\nFlow through spheres made of voxels of half a cell, n cells a period, five volume fractions (particle file beside the case file; a quarter of the period, mirrored): permeability against the drag of smooth spheres (Sangani & Acrivos 1982; Zick & Homsy 1982, Table 2) and against the same voxels by lattice Boltzmann, refined (lib/studies/reference/spheres.csv). The staircase lets 5 to 23 % less through than the smooth sphere, and coarse walls make up for a part of that. The explicit scheme's liquid leaves walls behind which there is no pressure; with 24 cells it takes minutes and is left out.",
    ),
    (
        "grain",
        "Flow along the grain of maple\n\nThrough 48 x 48 x 48 voxels of the acer stack (pipelines/examples/acer), n cells along an edge, joined to itself on all sides and full of liquid: permeability along the grain against the same voxels by lattice Boltzmann, refined (lib/studies/reference/README.md). Lattice Boltzmann with one node a voxel is 6.6 % too open, with 2 x 2 x 2 nodes 2.8 %: flow past the edges of voxels goes as r^0.54, which differences over one cell carry as r. The implicit scheme has factors for such edges (docs/methods.md section 3).",
    ),
    (
        "squeeze",
        "Squeeze film between plates\n\nAgainst 8 eta V a^3/h^3 per length, a as long as what was pressed out makes it.",
    ),
    (
        "disc8",
        "Squeeze film of a disc\n\nAgainst 3 pi eta R^4 V/(2 h^3), R of the voxels' area and as wide as what was pressed out makes it.",
    ),
    (
        "stefan",
        "A film closed by a press programme\n\nStefan's closing film, plates, to half of its gap under one load from 1 us to 1000 s, and under a ramp, a hold, a ramp down and a release: h^-5 grows with the integral of the load, since the film's volume stays. Worst row of the history; the same case but for the load and its time.",
    ),
    (
        "tait",
        "Compression\n\nA closed column by 2 %, pressure against paper Eq. 1. The piston moves off the nodes, so that the explicit scheme compresses the column 3 % less than it is; the law of each point is exact.",
    ),
    (
        "acoustic",
        "Standing sound wave\n\nHalf a wave over 32 cells: frequency against c^2 = K/rho, damping per period against (4/3 eta) k^2/(2 rho); what is beyond it at 0.001 Pa s is the update's own.",
    ),
    (
        "column",
        "Liquid at rest under a body force\n\nA free surface, 12 cells.",
    ),
    (
        "vortex",
        "Taylor-Green vortex\n\nDecay of the kinetic energy against 4 nu k^2. At 0.05 Pa s the explicit scheme rings instead of decaying: it holds div v = 0 on every point, which gives flows of constant volume a stiffness of about K (k cell)^4 (locking). The implicit scheme is made for flows without inertia; its error here is that of backward Euler steps.",
    ),
    (
        "drop",
        "Momentum\n\nA free drop whose quarters move differently, 0.5 us.",
    ),
    (
        "galilean",
        "Galilean invariance\n\nLiquid and walls all at 0.5 m/s, walls half a cell off the nodes, until all has moved by three cells. The speed is a power of two, which weights multiply without rounding: only a step that takes the velocity itself for a difference drifts.",
    ),
    (
        "sealed",
        "Sealed lumens\n\nUnder 2.5 MPa behind walls of 1 and 2 voxels.",
    ),
    (
        "clamp",
        "Load control\n\nA squeeze film closed under a pressure limit of 2.5 MPa. The resistance of the explicit scheme jumps where the moving wall crosses nodes, by more than its controller can follow without overshoot.",
    ),
];
