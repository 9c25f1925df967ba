// Share: a link that holds everything, and what can be taken away as a file.

import { useEffect, useState } from "preact/hooks";
import { address, LONG_ADDRESS, present } from "../share.ts";
import { canBeKept, keep, kept, letGo } from "../kept.ts";
import { Button } from "../widgets/button.tsx";
import { Callout } from "../widgets/callout.tsx";
import { CopyButton } from "../widgets/copy.tsx";
import { ExportPanel } from "./export.tsx";
import { saveFile } from "./robots.tsx";

export function SharePanel() {
  // Subscribes to all that the link holds.
  const now = present();
  const [link, setLink] = useState("");
  const text = JSON.stringify(now);
  useEffect(() => {
    let late = false;
    const timer = setTimeout(() => void address().then((made) => !late && setLink(made)), 200);
    return () => {
      late = true;
      clearTimeout(timer);
    };
  }, [text]);
  const isFile = location.protocol === "file:";
  const isHere = isFile || ["127.0.0.1", "localhost", "[::1]"].includes(location.hostname);
  return (
    <>
      <div class="heading">
        <h2>Share</h2>
      </div>
      <p class="fine">
        The link holds the table, the joints, the target, the path’s points and the view: nothing is stored anywhere else, and nothing is sent.
      </p>
      <div class="share-link">
        <input class="field" readOnly aria-label="Link to what this page shows" value={link} onFocus={(event) => event.currentTarget.select()} />
        <CopyButton label="Copy link" kind="main" text={address} done="The link is copied." />
      </div>
      <p class="fine number">{link ? `${link.length.toLocaleString("en")} characters` : " "}</p>
      {isHere && (
        <Callout tone="note">
          <span>This address works on this computer{isFile ? ", where the file of the page is" : " while “denavit view” runs"}. For somebody else, send the robot file.</span>
        </Callout>
      )}
      {link.length > LONG_ADDRESS && (
        <Callout tone="warning">
          <span>Some programs cut an address this long. The robot file is safer.</span>
        </Callout>
      )}
      <div class="row-of-buttons">
        <Button label="Save the robot file" icon="save" onClick={saveFile} />
      </div>
      <ExportPanel />
      {canBeKept() && <WithoutNetwork />}
    </>
  );
}

function WithoutNetwork() {
  const now = kept.value;
  const [isOpen, setOpen] = useState(now !== "no");
  return (
    <details class="section" open={isOpen} onToggle={(event) => setOpen(event.currentTarget.open)}>
      <summary>
        Without a network <span class="fine">{now === "yes" ? "kept on this device" : ""}</span>
      </summary>
      <p class="fine" role="status">
        {now === "yes" && "The page and all parts of its engine are on this device: it opens without a network, and can be installed as an application."}
        {now === "fetching" && "Fetching all parts of the page …"}
        {now === "no" && "The page can stay on this device with all parts of its engine, about 4 MB, and open without a network."}
      </p>
      <div class="row-of-buttons">
        {now === "yes" ? <Button label="Keep it no longer" onClick={() => void letGo()} /> : <Button label="Keep it on this device" disabled={now === "fetching"} onClick={() => void keep()} />}
      </div>
    </details>
  );
}
