use crate::axes::Frame;

/// Panels of equal scale side by side in rows, with room for axes on the left and below, a
/// label above, and a colour bar on the right of all.
pub(crate) struct Panels {
    pub(crate) frames: Vec<Frame>,
    /// Right end of the last column.
    pub(crate) right: f64,
    /// Lower end of the last row.
    pub(crate) bottom: f64,
    /// Height of the largest panel.
    pub(crate) height: f64,
}

/// Room around a panel, logical pixels.
#[derive(Clone, Copy)]
pub(crate) struct Room {
    pub(crate) left: f64,
    pub(crate) above: f64,
    pub(crate) below: f64,
    /// Least width of a column, for the labels of narrow panels.
    pub(crate) column: f64,
}

impl Panels {
    /// Places panels of the given edges (any unit), the longest of which becomes `longest`
    /// logical pixels.
    pub(crate) fn place(edges: &[[f64; 2]], longest: f64, room: Room) -> Self {
        let largest = |axis: usize| edges.iter().map(|e| e[axis]).fold(0.0, f64::max);
        let [widest, highest] = [largest(0), largest(1)];
        let most = if widest < 0.6 * highest { 6 } else { 3 };
        let columns = match edges.len() {
            4 if most == 3 => 2,
            n => n.clamp(1, most),
        };
        let rows = edges.len().div_ceil(columns);
        let scale = longest / widest.max(highest);
        let (width, height) = (widest * scale, highest * scale);
        let column = (room.left + width).max(room.column);
        let row = room.above + height + room.below;
        let frame = |(i, edges): (usize, &[f64; 2])| Frame {
            left: (i % columns) as f64 * column + room.left + 0.5 * (column - room.left - width),
            top: (i / columns) as f64 * row + room.above,
            width: edges[0] * scale,
            height: edges[1] * scale,
        };
        Self {
            frames: edges.iter().enumerate().map(frame).collect(),
            right: columns as f64 * column,
            bottom: rows as f64 * row,
            height,
        }
    }
}
