// Descriptions of trees in the dialog: which file, which chain, what xacro is given, and what there is to say.

import { useState } from "preact/hooks";
import type { Convention } from "../engine/types.ts";
import { said } from "../state.ts";
import { CONVENTIONS } from "../table/convention.tsx";
import { Button } from "../widgets/button.tsx";
import { Callout } from "../widgets/callout.tsx";
import { Words } from "../widgets/words.tsx";
import { Ends, Remarks } from "./chain.tsx";
import { descriptions } from "./files.ts";
import { asked, type Choice, read, tree } from "./open.ts";

interface Props {
  chooseFile(): void;
  chooseFolder(): void;
  /** The robot was taken. */
  done(): void;
}

export function TreePart({ chooseFile, chooseFolder, done }: Props) {
  const opened = asked.value ?? tree.value;
  return (
    <div class="from-text">
      <div class="row-of-buttons">
        <Button label="Open a file or zip" icon="open" onClick={chooseFile} />
        <Button label="Open a folder" icon="open" onClick={chooseFolder} />
        <span class="fine">or drop one anywhere on this page. Only a folder or zip brings included files and meshes.</span>
      </div>
      {opened ? <Choices key={opened.choice.main} done={done} /> : <p class="quiet">A URDF, one for xacro, or a model of MuJoCo’s is a tree of links: the table is that of a chain through it.</p>}
    </div>
  );
}

function Choices({ done }: { done(): void }) {
  const opened = asked.value ?? tree.value;
  const [given, setGiven] = useState(opened?.choice.given ?? "");
  if (!opened) return null;
  const { source, choice, answer } = opened;
  const found = descriptions(source.texts);
  const mains = found.includes(choice.main) ? found : [choice.main, ...found];
  const isAsked = answer.tree !== null && answer.tree.tip === null;

  // What is chosen is read again at once; the robot is taken by the button.
  const look = (part: Partial<Choice>) => void read(source, { ...choice, given, ...part }, false).catch(said);
  const take = () => {
    void read(source, { ...choice, given })
      .then((taken) => taken && done())
      .catch(said);
  };
  return (
    <>
      <div class="choices">
        {mains.length > 1 && (
          <label class="labelled">
            Description
            <select class="field" value={choice.main} onChange={(event) => look({ main: event.currentTarget.value, base: undefined, tip: undefined })}>
              {mains.map((path) => (
                <option key={path} value={path}>
                  {path}
                </option>
              ))}
            </select>
          </label>
        )}
        {mains.length === 1 && <p class="description">{choice.main}</p>}
      </div>
      <Ends opened={opened} isAsked={isAsked} onBase={(base) => look({ base })} onTip={(tip) => look({ tip })} />
      <div class="choices">
        <label class="labelled">
          Convention
          <select class="field" value={choice.convention ?? "standard"} onChange={(event) => look({ convention: event.currentTarget.value as Convention })}>
            {CONVENTIONS.map((one) => (
              <option key={one.value} value={one.value}>
                {one.label}
              </option>
            ))}
          </select>
        </label>
        <label class="labelled">
          Decimals of angles
          <select class="field" value={choice.asWritten ? "written" : "meant"} onChange={(event) => look({ asWritten: event.currentTarget.value === "written" })}>
            <option value="meant">1.5708 is 90°</option>
            <option value="written">As they are written</option>
          </select>
        </label>
        <label class="labelled">
          Arguments of xacro
          <input
            class="field"
            type="text"
            spellcheck={false}
            value={given}
            placeholder="name:=ur5e"
            onInput={(event) => setGiven(event.currentTarget.value)}
            onChange={() => look({})}
          />
        </label>
      </div>
      {answer.tree?.words && (
        <Callout tone="good">
          <span>
            <Words text={`${answer.tree.words}.`} />
          </span>
        </Callout>
      )}
      <div class="row-of-buttons end">
        <Button label="Take this chain" kind="main" disabled={answer.file === null} onClick={take} />
      </div>
      <Remarks opened={opened} />
    </>
  );
}
