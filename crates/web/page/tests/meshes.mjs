// Meshes of a description: each kind, where they stand, and what is said of those that are missing, too large, or none.
import assert from "node:assert/strict";
import { strToU8, zipSync } from "fflate";
import { address, figure, open, openRobot, saysInStatus, scenario, shared, tab, until } from "./support.mjs";

const visual = (geometry, origin = "") => `<visual>${origin}<geometry>${geometry}</geometry></visual>`;
const mesh = (file, more = "") => `<mesh filename="${file}" ${more}/>`;

/** One joint about z, 1 m up; what stands on the base and what turns. */
function robot(base, turning) {
  return (
    `<robot name="drawn"><link name="a">${base}</link><link name="b">${turning}</link><joint name="j" type="revolute"><parent link="a"/>` +
    `<child link="b"/><origin xyz="0 0 1"/><axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>` +
    `<link name="tip"/><joint name="f" type="fixed"><parent link="b"/><child link="tip"/><origin xyz="0.5 0 0"/></joint></robot>`
  );
}

/** A triangle from the origin along x and y, 3 and 2 long, as text. */
const STL = "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 3 0 0\nvertex 0 2 0\nendloop\nendfacet\nendsolid t\n";
const OBJ = "mtllib nowhere.mtl\nv 0 0 0\nv 3 0 0\nv 0 2 0\nf 1 2 3\n";
const collada = (up, meter) =>
  `<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><unit meter="${meter}"/><up_axis>${up}</up_axis></asset>` +
  `<library_images><image id="i"><init_from>../../wood.png</init_from></image></library_images>` +
  `<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="pa" count="9">0 0 0 3 0 0 0 2 0</float_array><technique_common>` +
  `<accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>` +
  `<vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>` +
  `<library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>`;

const CORNERS = Buffer.from(new Float32Array([0, 0, 0, 3, 0, 0, 0, 2, 0]).buffer);
const gltf = (uri) =>
  JSON.stringify({
    asset: { version: "2.0" },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, material: 0 }] }],
    materials: [{ pbrMetallicRoughness: { baseColorTexture: { index: 0 } } }],
    textures: [{ source: 0 }],
    images: [{ uri: "wood.png" }],
    accessors: [{ bufferView: 0, componentType: 5126, count: 3, type: "VEC3", min: [0, 0, 0], max: [3, 2, 0] }],
    bufferViews: [{ buffer: 0, byteLength: 36 }],
    buffers: [{ byteLength: 36, uri }],
  });

/** Drops files as a zip; how long it takes from then until all bodies are there, milliseconds. */
async function drop(page, files) {
  const zip = zipSync(Object.fromEntries(Object.entries(files).map(([path, content]) => [path, typeof content === "string" ? strToU8(content) : new Uint8Array(content)])));
  const before = await page.evaluate(() => window.denavit.trees);
  const [chooser] = await Promise.all([page.waitForEvent("filechooser"), page.getByRole("button", { name: "Open", exact: true }).click()]);
  const start = performance.now();
  await chooser.setFiles({ name: "robot.zip", mimeType: "application/zip", buffer: Buffer.from(zip) });
  await until(() => page.evaluate((n) => window.denavit.trees > n, before), "the bodies are there");
  return performance.now() - start;
}

const box = (page) => page.evaluate(() => window.denavit.box());

function near(found, wanted, words) {
  const far = Math.max(...wanted.flat().map((x, k) => Math.abs(x - found.flat()[k])));
  assert.ok(found.length === 2 && far < 1e-4, `${words}: ${JSON.stringify(found)} and not ${JSON.stringify(wanted)}`);
}

/** Each mesh alone on the base: what is written, and the box that it fills, metres. */
const MESHES = [
  ["m.stl", { "m.stl": STL }, 'scale="0.1 0.2 1"', [[0, 0, 0], [0.3, 0.4, 0]]],
  ["m.obj", { "m.obj": OBJ }, 'scale="0.1"', [[0, 0, 0], [0.3, 0.2, 0]]],
  ["m.dae", { "m.dae": collada("Z_UP", 1) }, "", [[0, 0, 0], [3, 2, 0]]],
  // Inches, and y up: 2 inches up are 50.8 mm along z.
  ["m.dae", { "m.dae": collada("Y_UP", 0.0254) }, "", [[0, 0, 0], [0.0762, 0, 0.0508]]],
  ["m.gltf", { "m.gltf": gltf("m.bin"), "m.bin": CORNERS }, "", [[0, 0, 0], [3, 2, 0]]],
  ["m.gltf", { "m.gltf": gltf(`data:application/octet-stream;base64,${CORNERS.toString("base64")}`) }, "", [[0, 0, 0], [3, 2, 0]]],
];

scenario("meshes of each kind stand where the file says, and move with the joints", async (page) => {
  await openRobot(page, "scara");
  assert.equal(await page.getByRole("button", { name: "Bodies of the robot" }).count(), 0);
  for (const [name, files, more, wanted] of MESHES) {
    const inFolder = Object.fromEntries(Object.entries(files).map(([path, content]) => [`arm/meshes/${path}`, content]));
    await drop(page, { "arm/urdf/arm.urdf": robot(visual(mesh(`package://arm/meshes/${name}`, more)), ""), ...inFolder });
    near(await box(page), wanted, `${name} ${more}`);
    assert.equal(await page.evaluate(() => window.denavit.bodies), 1, name);
  }
  // Boxes need no file; one is turned by a right angle about z on the base, the other stands on the link that turns.
  const turned = '<origin xyz="0 0 0.5" rpy="0 0 1.5707963267948966"/>';
  await drop(page, { "arm.urdf": robot(visual('<box size="0.4 0.2 0.1"/>', turned), visual('<cylinder radius="0.05" length="0.2"/>', '<origin xyz="1 0 0"/>')) });
  await tab(page, "Joints").click();
  await page.getByRole("textbox", { name: /^q1\b/ }).fill("90");
  await page.keyboard.press("Enter");
  await until(async () => Math.abs((await box(page))[1][1] - 1.05) < 0.002, "the cylinder is at y = 1 m");
  const [low, high] = await box(page);
  near([low, high], [[-0.1, -0.2, 0.45], [0.1, high[1], 1.1]], "boxes");

  const bodies = page.getByRole("button", { name: "Bodies of the robot" });
  const calls = () => page.evaluate(() => window.denavit.calls);
  const shown = await calls();
  await bodies.click();
  await until(async () => (await calls()) < shown, "bodies are hidden");
  assert.equal(await bodies.getAttribute("aria-pressed"), "false");
});

scenario("a model for MuJoCo is opened with its geoms and meshes, the one that includes it is not", async (page) => {
  await openRobot(page, "scara");
  const model =
    '<mujoco model="arm"><compiler angle="radian" meshdir="assets"/><asset><mesh name="m" file="m.stl" scale="0.1 0.1 0.1"/></asset><worldbody>' +
    '<body name="a"><geom type="capsule" size="0.1" fromto="0 0 0 0 0 1"/><geom type="box" size="5 5 5" group="3"/>' +
    '<body name="b" pos="0 0 1"><joint name="turn" axis="0 0 1"/><geom type="ellipsoid" size="0.05 0.04 0.2"/><geom type="mesh" mesh="m" pos="1 0 0"/></body></body></worldbody></mujoco>';
  await drop(page, { "arm/arm.xml": model, "arm/scene.xml": '<mujoco><include file="arm.xml"/><worldbody><geom type="box" size="3 3 3"/></worldbody></mujoco>', "arm/assets/m.stl": STL });
  assert.equal(await page.evaluate(() => window.denavit.bodies), 3, "what collides is not drawn");
  await tab(page, "Joints").click();
  await page.getByRole("textbox", { name: /^q1\b/ }).fill("0");
  await page.keyboard.press("Enter");
  await until(async () => Math.abs((await box(page))[1][0] - 1.3) < 1e-4, "the mesh is at x = 1 m");
  // The mesh reaches to x = 1.3 and y = 0.2; the capsule begins at z = -0.1, the ellipsoid ends at 1.2.
  near(await box(page), [[-0.1, -0.1, -0.1], [1.3, 0.2, 1.2]], "geoms");
});

/** A ball of so many triangles, 0.1 in size, as binary STL. */
function ball(rings) {
  const bytes = new DataView(new ArrayBuffer(84 + 50 * 2 * rings * rings));
  bytes.setUint32(80, 2 * rings * rings, true);
  const corner = (i, j) => {
    const [a, b] = [(Math.PI * i) / rings, (2 * Math.PI * j) / rings];
    return [0.1 * Math.sin(a) * Math.cos(b), 0.1 * Math.sin(a) * Math.sin(b), 0.1 * Math.cos(a)];
  };
  let place = 84;
  for (let i = 0; i < rings; i += 1)
    for (let j = 0; j < rings; j += 1)
      for (const triangle of [[corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)], [corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)]]) {
        triangle.flat().forEach((x, k) => bytes.setFloat32(place + 12 + 4 * k, x, true));
        place += 50;
      }
  return Buffer.from(bytes.buffer);
}

// As many links and triangles as the URDF of an arm with its meshes has; 2 s on a machine that does nothing else.
scenario("a robot of 100 links with meshes of 200,000 triangles is opened soon", { alone: true }, async (page) => {
  await openRobot(page, "scara");
  const mesh20k = ball(100);
  const links = Array.from({ length: 100 }, (_, k) => {
    const look = k % 10 === 0 ? visual(mesh(`package://arm/meshes/m${k}.stl`)) : "";
    const moves = k % 15 === 0 ? "revolute" : "fixed";
    const joint = `<joint name="j${k}" type="${moves}"><origin xyz="0.01 0 0.02" rpy="0 0 0.3"/><parent link="l${k}"/><child link="l${k + 1}"/><axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>`;
    return `<link name="l${k}">${look}</link>${joint}`;
  });
  const files = Object.fromEntries(Array.from({ length: 10 }, (_, k) => [`arm/meshes/m${10 * k}.stl`, mesh20k]));
  const took = await drop(page, { "arm/urdf/arm.urdf": `<robot name="arm">${links.join("")}<link name="l100"/></robot>`, ...files });
  assert.equal(await page.evaluate(() => window.denavit.bodies), 10);
  figure("a robot of 100 links with 200,000 triangles is there", took, "ms", 2000);
});

// How Chromium says that XML is broken has a style that no page with this policy may have.
scenario("missing, foreign, broken and too large meshes are said, and the robot is there", { expected: [/inline style/] }, async (page) => {
  await openRobot(page, "scara");
  const files = ["package://away/meshes/one.stl", "package://away/meshes/two.stl", "package://arm/../../secret.stl", "../../../secret.stl", "http://example.org/x.stl"];
  const base = [...files.map((file) => mesh(file)), '<box size="0.1 0.1 0.1"/>', mesh("huge.stl"), mesh("broken.dae"), mesh("lost.gltf"), mesh("climbs.gltf")].map((one) => visual(one)).join("");
  await drop(page, {
    "ws/arm/arm.urdf": robot(base, ""),
    "ws/secret.stl": STL,
    "ws/arm/huge.stl": Buffer.alloc(65 * 2 ** 20),
    "ws/arm/broken.dae": "<COLLADA",
    "ws/arm/lost.gltf": gltf("gone.bin"),
    "ws/arm/climbs.gltf": gltf("../secret.bin"),
    "ws/secret.bin": CORNERS,
  });
  assert.equal(await page.evaluate(() => window.denavit.bodies), 1, "the box alone");
  await saysInStatus(page, /4 meshes are not drawn: huge\.stl \(it is larger than 64 MiB\)/);
  await page.getByRole("region", { name: /^Chain of / }).getByRole("button", { name: "Its file …" }).click();
  const said = await page.getByRole("dialog").textContent();
  assert.match(said, /2 meshes of the package away are not among the files/);
  assert.match(said, /1 mesh of the package arm is not among the files/);
  assert.match(said, /2 meshes are not among the files/);
});

scenario("a tree that the page is served with is opened, its meshes by number", async (page) => {
  const name = "home/me/ws/arm/urdf/arm.urdf";
  const bundle = {
    arguments: [],
    as_written: false,
    base: null,
    convention: "craig",
    meshes: [["home/me/ws/other/meshes/m.stl", "mesh/0", STL.length]],
    name,
    packages: [["arm", "home/me/ws/other"]],
    texts: [[name, robot(visual(mesh("package://arm/meshes/m.stl")), "")]],
    tip: null,
  };
  const asked = [];
  await page.route("**/robot.json", (route) => route.fulfill({ json: bundle }));
  await page.route("**/mesh/*", (route) => {
    asked.push(new URL(route.request().url()).pathname);
    return route.fulfill({ body: STL, contentType: "application/octet-stream" });
  });
  await page.route(address(), async (route) => {
    const response = await route.fetch();
    const body = (await response.text()).replace("<head>", '<head>\n<meta name="denavit-robot" content="robot.json">');
    await route.fulfill({ response, body });
  });
  await open(page);
  await until(() => page.evaluate(() => window.denavit.trees === 1), "the bodies are there");
  near(await box(page), [[0, 0, 0], [3, 2, 0]], "the mesh");
  assert.deepEqual(asked, ["/mesh/0"]);
  const held = await shared(page, (s) => s.file.name === "drawn", "the robot is there");
  assert.equal(held.file.convention, "craig");
});
