// Begins: draws the frame, loads the engine, brings the first robot.

import { render } from "preact";
import { App } from "./app.tsx";
import { asked } from "./asked.ts";
import { load } from "./engine/client.ts";
import { lookIfKept } from "./kept.ts";
import { openListed, openText } from "./panels/robots.tsx";
import { keepAddress, restoreAddress } from "./share.ts";
import { keepPreferences, phase } from "./shell.ts";
import { batch, file, forget, hasPicture, panel, robot, said, selected, show, start, topic } from "./state.ts";
import { type Bundle, openServed } from "./tree/open.ts";

const FIRST = "staubli-rx90";

async function main(): Promise<void> {
  const root = document.getElementById("app");
  if (!root) return;
  if (asked.theme) show({ theme: asked.theme });
  // A page around this one has its own looks, and nobody chose those of its frame for good.
  keepPreferences(asked.embedded !== null);
  // The skeleton in the HTML is the same frame: nothing moves when it is replaced.
  root.replaceChildren();
  render(<App />, root);
  if (typeof WebAssembly !== "object") {
    phase.value = { kind: "failed", words: "This page computes with WebAssembly, which this browser does not have or does not allow." };
    return;
  }
  try {
    start(await load());
  } catch (why) {
    phase.value = { kind: "failed", words: `The engine could not be loaded: ${why instanceof Error ? why.message : String(why)}` };
    return;
  }
  await firstRobot();
  askedView();
  phase.value = { kind: "ready" };
  // Where nothing can be drawn the arm is solved all the same.
  setTimeout(hasPicture, 1500);
  if (asked.embedded !== null) return;
  keepAddress();
  void lookIfKept();
}

/** The panel and the row that the address asks for. */
function askedView(): void {
  const rows = robot.value?.rows ?? 0;
  batch(() => {
    if (asked.panel) panel.value = asked.panel;
    if (asked.topic) topic.value = asked.topic;
    if (asked.row !== null && asked.row < rows) selected.value = asked.row;
  });
}

/** From the address, whole or by its name; else the one that the server gives; else one of the catalogue. */
async function firstRobot(): Promise<void> {
  if (await restoreAddress()) return;
  if (asked.robot) {
    openListed(asked.robot);
    forget();
  }
  if (file.value.joints.length > 0) return;
  const given = document.querySelector<HTMLMetaElement>('meta[name="denavit-robot"]')?.content;
  if (given) {
    try {
      const answer = await fetch(new URL(given, document.baseURI));
      if (!answer.ok) throw new Error(`The robot file could not be fetched (${answer.status}).`);
      if (given.endsWith(".json")) await openServed((await answer.json()) as Bundle);
      else await openText(await answer.text(), given);
    } catch (why) {
      said(why);
    }
  }
  if (file.value.joints.length === 0) openListed(FIRST);
}

void main();
