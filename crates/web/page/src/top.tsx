// The bar above: which robot, where it comes from and goes to, undo and redo, units and theme.

import { chooseFile, dialog, saveFile } from "./panels/robots.tsx";
import { phase } from "./shell.ts";
import { canRedo, canUndo, file, type Look, look, redo, show, undo } from "./state.ts";
import { flush } from "./table/cells.ts";
import { Button } from "./widgets/button.tsx";
import { ArmIcon, Icon, type IconName } from "./widgets/icons.tsx";

export function TopBar() {
  const isReady = phase.value.kind === "ready";
  const { name } = file.value;
  const choose = () => (dialog.value = { part: "catalogue" });
  return (
    <header class="top">
      <h1 class="spoken">{name ? `Denavit: ${name}` : "Denavit"}</h1>
      <span class="brand" aria-hidden="true">
        <ArmIcon />
        <span class="words">Denavit</span>
      </span>
      {isReady && (
        <>
          <span class="rule" />
          <button type="button" class="robot-name" aria-haspopup="dialog" aria-label={`${name || "Robot without a name"}: choose another robot`} title={name} onClick={choose}>
            <span>{name || "Robot without a name"}</span>
            <Icon name="down" size={16} />
          </button>
          <span class="space" />
          <Button label="Robots" icon="robots" kind="plain" class="wide" hint="The catalogue (Ctrl K)" onClick={choose} />
          <Button label="Open" icon="open" kind="plain" hint="Open a robot file (Ctrl O)" class="named" onClick={chooseFile} />
          <Button label="Save" icon="save" kind="plain" hint="Save the robot file (Ctrl S)" class="named" onClick={saveFile} />
          <span class="rule" />
          <Button label="Undo" icon="undo" bare kind="plain" hint="Undo (Ctrl Z)" disabled={!canUndo.value} onClick={() => step(undo)} />
          <Button label="Redo" icon="redo" bare kind="plain" hint="Redo (Ctrl Y)" disabled={!canRedo.value} onClick={() => step(redo)} />
          <span class="rule" />
          <UnitButtons />
          <ThemeButton />
        </>
      )}
    </header>
  );
}

function step(by: () => void): void {
  flush();
  by();
}

function UnitButtons() {
  const { angles, lengths } = look.value;
  return (
    <>
      <button
        type="button"
        class="button plain unit"
        aria-label={`Angles in ${angles === "deg" ? "degrees; change to radians" : "radians; change to degrees"}`}
        title={`Angles in ${angles === "deg" ? "degrees" : "radians"}`}
        onClick={() => show({ angles: angles === "deg" ? "rad" : "deg" })}
      >
        {angles}
      </button>
      <button
        type="button"
        class="button plain unit"
        aria-label={`Lengths in ${lengths === "mm" ? "millimetres; change to metres" : "metres; change to millimetres"}`}
        title={`Lengths in ${lengths === "mm" ? "millimetres" : "metres"}`}
        onClick={() => show({ lengths: lengths === "mm" ? "m" : "mm" })}
      >
        {lengths}
      </button>
    </>
  );
}

const THEMES: Record<Look["theme"], { next: Look["theme"]; icon: IconName; words: string }> = {
  system: { next: "light", icon: "system", words: "as the system has it" },
  light: { next: "dark", icon: "sun", words: "light" },
  dark: { next: "system", icon: "moon", words: "dark" },
};

function ThemeButton() {
  const { next, icon, words } = THEMES[look.value.theme];
  return <Button label={`Theme: ${words}; change to ${THEMES[next].words}`} icon={icon} bare kind="plain" onClick={() => show({ theme: next })} />;
}
