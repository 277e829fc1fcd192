//! Liquid drawn into a slit or a tube by its surface, or kept out: Lucas-Washburn, no entry, Jurin's height.
