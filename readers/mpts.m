% Reads a particle file of bondline (lib/particle-file/FORMAT.md) in Octave or MATLAB.
%   s = mpts("final.mpts"); s.arrays.position   % (n, 3), m; blocks as logical (nx, ny, nz)
% Names of arrays have their '-' written as '_'.
function s = mpts(path)
  f = fopen(path, "r", "ieee-le");
  if f < 0, error("cannot open %s", path); end
  closing = onCleanup(@() fclose(f));
  u32 = @() fread(f, 1, "uint32"); u64 = @() fread(f, 1, "uint64"); f64 = @(n) fread(f, n, "double")';
  text = @() fread(f, [1 u64()], "uint8=>char");
  magic = fread(f, 8, "uint8")'; version = u32(); u32(); len = u64(); u64();
  fseek(f, 0, "eof");
  if ! isequal(magic, [137 77 80 84 83 13 10 26]) || version != 1 || len != ftell(f)
    error("%s is not a whole particle file of version 1", path);
  end
  fseek(f, 32, "bof");
  kinds = {"specimen", "bond", "state", "checkpoint"};
  s.kind = kinds{u32() + 1}; s.voxel_m = f64(1); s.normal = fread(f, 1, "uint8");
  s.box_min_m = f64(3); s.box_max_m = f64(3); s.time_s = f64(1); s.step = u64();
  s.blocks = struct([]);
  for i = 1:u64()
    b.name = text(); b.adhesive = u32(); b.dims = [u64() u64() u64()];
    b.origin_m = f64(3); b.voxel_m = f64(1); b.count = u64();
    s.blocks = [s.blocks b];
  end
  s.particles = u64();
  s.attributes = cell(u64(), 2);
  for i = 1:rows(s.attributes), s.attributes(i, :) = {text(), text()}; end
  for i = 1:u64()                                        % provenance is passed over
    text(); text();
    for k = 1:u64(), text(); end
    for k = 1:u64(), text(); u64(); end
  end
  types = {"uint8", "single", "double", "uint32", "uint64", "uint8", "uint8"};
  for i = 1:u64()
    a(i).name = strrep(text(), "-", "_"); a(i).element = u32(); a(i).size = [u32() u64()];
    a(i).offset = u64(); u64();
  end
  for i = 1:numel(a)
    fseek(f, a(i).offset, "bof");
    if a(i).element == 0                                 % rows of 64-bit words, lowest bit first
      n = s.blocks(i).dims;
      bytes = fread(f, [8 * a(i).size(1) a(i).size(2)], "uint8=>uint8");
      bits = false(64 * a(i).size(1), a(i).size(2));
      for k = 1:8, bits(k:8:end, :) = bitget(bytes, k); end
      s.arrays.(a(i).name) = reshape(bits(1:n(1), :), n);
    else
      type = types{a(i).element + 1};
      s.arrays.(a(i).name) = fread(f, a(i).size, [type "=>" type])';
    end
  end
end
