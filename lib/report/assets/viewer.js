// Shows scenes as views that can be turned. Without it, and on paper, their pictures stay.
(() => {
  "use strict";
  const VERTEX = `
    attribute vec3 position, normal;
    uniform mat4 modelViewMatrix, projectionMatrix;
    uniform float nearer;
    varying vec3 place, facing;
    varying float depth;
    void main() {
      vec4 seen = modelViewMatrix * vec4(position, 1.0);
      place = seen.xyz;
      facing = mat3(modelViewMatrix) * normal;
      depth = position.z;
      // Where liquid lies on wood, the liquid is seen.
      seen.xyz *= 1.0 - nearer;
      gl_Position = projectionMatrix * seen;
    }`;
  const FRAGMENT = `
    precision highp float;
    uniform vec3 colour, inside;
    uniform float cut;
    varying vec3 place, facing;
    varying float depth;
    void main() {
      if (depth > cut) discard;
      float light = 0.35 + 0.65 * abs(dot(normalize(facing), normalize(-place)));
      gl_FragColor = vec4(gl_FrontFacing ? colour * light : inside, 1.0);
    }`;
  const LINE = `
    precision highp float;
    void main() { gl_FragColor = vec4(0.45, 0.45, 0.45, 1.0); }`;
  const PLAIN = `
    attribute vec3 position;
    uniform mat4 modelViewMatrix, projectionMatrix;
    void main() { gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`;

  // What mesh.rs packs: counts, then differences whose low bytes come before the next higher ones.
  async function unpacked(text, edges) {
    const packed = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
    const [vertices, triangles] = new Uint32Array(bytes.buffer, 0, 2);
    const sums = (from, count, width) => {
      const values = new Uint32Array(count);
      for (let i = 0; i < count; i++) {
        for (let b = 0; b < width; b++) values[i] |= bytes[from + b * count + i] << (8 * b);
        if (i >= 3) values[i] += values[i - 3];
      }
      return values;
    };
    const places = sums(8, 3 * vertices, 2);
    const index = sums(8 + 6 * vertices, 3 * triangles, 4);
    const position = new Float32Array(3 * vertices);
    for (let i = 0; i < position.length; i++) {
      position[i] = ((places[i] & 0xffff) / 0xffff - 0.5) * edges[i % 3];
    }
    return { position, index, normal: normals(position, index) };
  }

  function normals(position, index) {
    const normal = new Float32Array(position.length);
    for (let t = 0; t < index.length; t += 3) {
      const [a, b, c] = [index[t], index[t + 1], index[t + 2]].map((i) => 3 * i);
      const u = [0, 1, 2].map((k) => position[b + k] - position[a + k]);
      const v = [0, 1, 2].map((k) => position[c + k] - position[a + k]);
      for (let k = 0; k < 3; k++) {
        const [i, j] = [(k + 1) % 3, (k + 2) % 3];
        const part = u[i] * v[j] - u[j] * v[i];
        for (const corner of [a, b, c]) normal[corner + k] += part;
      }
    }
    return normal;
  }

  function boxLines(edges) {
    const lines = [];
    for (let axis = 0; axis < 3; axis++) {
      for (let corner = 0; corner < 4; corner++) {
        for (const end of [-0.5, 0.5]) {
          const place = [0, 0, 0];
          place[axis] = end * edges[axis];
          place[(axis + 1) % 3] = ((corner & 1) - 0.5) * edges[(axis + 1) % 3];
          place[(axis + 2) % 3] = ((corner >> 1) - 0.5) * edges[(axis + 2) % 3];
          lines.push(...place);
        }
      }
    }
    return new Float32Array(lines);
  }

  function control(kind, text, change) {
    const label = document.createElement("label");
    const input = Object.assign(document.createElement("input"), { type: kind });
    label.append(...(kind === "range" ? [text, input] : [input, text]));
    input.addEventListener("input", () => change(input));
    return { label, input };
  }

  async function view(figure) {
    const { edges, turn, tilt, ...packed } = JSON.parse(figure.querySelector("script").textContent);
    const image = figure.querySelector("img");
    const canvas = document.createElement("canvas");
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", image.alt + ". Arrow keys turn it, plus and minus zoom.");
    const bodies = {
      wood: await unpacked(packed.wood, edges),
      adhesive: await unpacked(packed.adhesive, edges),
    };
    const renderer = new OGL.Renderer({ canvas, dpr: Math.min(window.devicePixelRatio, 2), antialias: true });
    const gl = renderer.gl;
    if (!gl) return;
    // The page's style says how large it is shown.
    const unsized = () => { canvas.style.width = canvas.style.height = ""; };
    unsized();
    gl.clearColor(1, 1, 1, 1);
    const size = Math.hypot(...edges);
    const camera = new OGL.Camera(gl, { fov: 30, near: 0.02 * size, far: 20 * size });
    const scene = new OGL.Transform();
    const mesh = ({ position, normal, index }, colour, inside, nearer) => {
      const program = new OGL.Program(gl, {
        vertex: VERTEX,
        fragment: FRAGMENT,
        cullFace: false,
        uniforms: { colour: { value: colour }, inside: { value: inside }, nearer: { value: nearer }, cut: { value: 0 } },
      });
      const geometry = new OGL.Geometry(gl, {
        position: { size: 3, data: position },
        normal: { size: 3, data: normal },
        index: { data: index },
      });
      const made = new OGL.Mesh(gl, { geometry, program });
      made.setParent(scene);
      return made;
    };
    const colours = (...of) => of.map((c) => c / 255);
    const wood = mesh(bodies.wood, colours(190, 180, 168), colours(128, 112, 96), 0);
    const adhesive = mesh(bodies.adhesive, colours(230, 150, 20), colours(170, 105, 5), 5e-4);
    const lines = new OGL.Geometry(gl, { position: { size: 3, data: boxLines(edges) } });
    const box = new OGL.Program(gl, { vertex: PLAIN, fragment: LINE });
    new OGL.Mesh(gl, { mode: gl.LINES, geometry: lines, program: box }).setParent(scene);

    const look = (azimuth, elevation, distance) => camera.position.set(
      distance * Math.sin(azimuth) * Math.cos(elevation),
      distance * Math.sin(elevation),
      distance * Math.cos(azimuth) * Math.cos(elevation),
    );
    look(turn, tilt, 2.2 * size);
    image.before(canvas);
    const orbit = new OGL.Orbit(camera, { element: canvas, target: new OGL.Vec3(), enabled: false, minDistance: 0.3 * size, maxDistance: 6 * size });
    // The wheel moves the page until the view is taken hold of.
    canvas.addEventListener("pointerdown", () => { orbit.enabled = true; canvas.focus(); });
    canvas.addEventListener("blur", () => { orbit.enabled = false; });
    canvas.addEventListener("keydown", (event) => {
      const [x, y, z] = camera.position;
      let distance = Math.hypot(x, y, z), elevation = Math.asin(y / distance), azimuth = Math.atan2(x, z);
      switch (event.key) {
        case "ArrowLeft": azimuth -= 0.1; break;
        case "ArrowRight": azimuth += 0.1; break;
        case "ArrowUp": elevation = Math.min(elevation + 0.1, 1.5); break;
        case "ArrowDown": elevation = Math.max(elevation - 0.1, -1.5); break;
        case "+": distance = Math.max(distance / 1.1, 0.3 * size); break;
        case "-": distance = Math.min(distance * 1.1, 6 * size); break;
        default: return;
      }
      event.preventDefault();
      look(azimuth, elevation, distance);
      orbit.forcePosition();
    });

    const controls = Object.assign(document.createElement("div"), { className: "controls" });
    const cut = (body, text, kept) => {
      const shown = control("checkbox", text, (input) => { body.visible = input.checked; });
      shown.input.checked = true;
      const place = (input) => { body.program.uniforms.cut.value = (input.value / 100 - 0.5) * edges[2] * 1.001; };
      const depth = control("range", "cut " + text, place);
      depth.input.value = kept;
      place(depth.input);
      controls.append(shown.label, depth.label);
    };
    cut(adhesive, "adhesive", 100);
    cut(wood, "wood", 50);
    canvas.after(controls);

    const draw = () => {
      requestAnimationFrame(draw);
      const { clientWidth, clientHeight } = canvas;
      if (canvas.width !== Math.round(clientWidth * renderer.dpr)) {
        renderer.setSize(clientWidth, clientHeight);
        unsized();
        camera.perspective({ aspect: clientWidth / clientHeight });
      }
      orbit.update();
      renderer.render({ scene, camera });
    };
    draw();
    figure.dataset.view = "ready";
  }

  for (const figure of document.querySelectorAll("figure.scene")) {
    view(figure).catch((error) => { figure.dataset.view = "failed: " + error; });
  }
})();
