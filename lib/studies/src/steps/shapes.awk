# Voids (v) in a block of wood (w) of 16 x 64 x 16 voxels, x fastest; the bond plane is at y = 32.
function void() {
    if (shape == "pits") return y >= 20 && y < 44 && x % 8 > 0 && x % 8 < 7 && z % 8 > 0 && z % 8 < 7
    if (shape == "slits-1") return y >= 16 && y < 48 && x % 2
    if (shape == "slits-3") return y >= 16 && y < 48 && x % 8 > 1 && x % 8 < 5
    # Lumens along z that open to the bond over a part of their length; holes above.
    if (shape == "dead-ends") return y < 32 ? x >= 4 && x < 12 && y >= 14 && (y < 22 || z >= 4) : y < 50 && x % 8 > 0 && x % 8 < 6 && z >= 4
    # A round one along z, cut open above its middle.
    if (shape == "vessel") return (x - 7.5) ^ 2 + (y - 28.5) ^ 2 < 49 || (y >= 32 && y < 44 && x % 8 > 1 && x % 8 < 6)
}
BEGIN { for (z = 0; z < 16; z++) for (y = 0; y < 64; y++) for (x = 0; x < 16; x++) printf void() ? "v" : "w" }
