// The other arms in the picture, with their names at their feet.

import { computed } from "@preact/signals";
import { build, plate } from "../scene/body.ts";
import { add } from "../scene/geometry.ts";
import { Solids, type Tint } from "../scene/solids.ts";
import type { Stage } from "../scene/stage.ts";
import { colours } from "../scene/theme.ts";
import { fit } from "../scene/view-fit.ts";
import { others, standing } from "./beside.ts";

const count = computed(() => others.value.length);

export function addBeside(stage: Stage): void {
  const solids = new Solids(["matte"], 2);
  stage.add(solids.object);
  stage.onEnd(() => solids.dispose());
  stage.watch(
    "beside",
    () => ({ list: standing.value, palette: colours.value }),
    ({ list, palette }) => {
      solids.begin();
      const [link, rod, palm, pin]: Tint[] = [[palette.link, 0], [palette.rod, 0], [palette.hand, 0], [palette.pin, 0]];
      const joints = { R: [palette.revolute, 0] as Tint, P: [palette.prismatic, 0] as Tint };
      for (const { scene } of list) {
        build(solids, scene, scene.unit, { joint: (kind) => joints[kind], pin: () => pin, bar: (_, isRod) => (isRod ? rod : link), palm }, true);
        plate(solids, scene.ground, scene.unit, [palette.base, 0]);
      }
      solids.end();
      stage.labels.set(
        "beside",
        list.map(({ beside, scene }) => ({ text: beside.model.robot, at: add(scene.ground.at, [0, 0, -1], scene.unit), toward: [0, 0, -scene.unit], colour: palette.text, size: 13, plate: true, rank: 12 })),
      );
    },
  );
  // Whoever comes or goes changes what has to be seen.
  let before = 0;
  stage.watch("beside fit", () => count.value, (now) => {
    if (now !== before) fit(stage, true);
    before = now;
  });
}
