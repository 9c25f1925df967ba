// A document of the engine, block by block.

import type { Block } from "../engine/types.ts";
import { Equations, FormulaLine } from "./formula.tsx";
import { Picture, wordsOf } from "./figure.tsx";
import { TreeView } from "./tree.tsx";
import { CopyButton } from "../widgets/copy.tsx";
import type { CurrentValues } from "./values.ts";

export function Blocks({ blocks, values }: { blocks: Block[]; values: CurrentValues | null }) {
  // A part of a report begins below its first heading; here there is the page's own above.
  const first = Math.min(...blocks.map((block) => (block.kind === "heading" ? block.level : Infinity)));
  return (
    <>
      {blocks.map((block, k) => (
        <BlockView key={k} block={block} depth={block.kind === "heading" ? block.level - first : 0} values={values} />
      ))}
    </>
  );
}

function BlockView({ block, depth, values }: { block: Block; depth: number; values: CurrentValues | null }) {
  switch (block.kind) {
    case "heading": {
      const Heading = depth === 0 ? "h2" : depth === 1 ? "h3" : "h4";
      return <Heading dangerouslySetInnerHTML={{ __html: block.html }} />;
    }
    case "paragraph":
      return <p dangerouslySetInnerHTML={{ __html: block.html }} />;
    case "list":
      return (
        <ul>
          {block.items.map((item, k) => (
            <li key={k} dangerouslySetInnerHTML={{ __html: item }} />
          ))}
        </ul>
      );
    case "formula":
      return <FormulaLine formula={block.formula} number={block.number} proof={block.proof} values={values} />;
    case "equations":
      return <Equations formulas={block.formulas} values={values} />;
    case "beside":
      return (
        <div class="beside">
          {block.formulas.map((formula, k) => (
            <FormulaLine key={k} formula={formula} values={null} />
          ))}
        </div>
      );
    case "table":
      return <Table block={block} />;
    case "tree":
      return <TreeView root={block.root} />;
    case "figure":
      return (
        <figure>
          <div class="pictures">
            {block.svgs.map(({ svg, caption }, k) => (
              <div key={k}>
                <Picture svg={svg} words={wordsOf(caption || block.caption)} />
                {caption && <p dangerouslySetInnerHTML={{ __html: caption }} />}
              </div>
            ))}
          </div>
          <figcaption dangerouslySetInnerHTML={{ __html: block.caption }} />
        </figure>
      );
    case "summary":
      return (
        <dl class="summary">
          {block.rows.map(([label, value], k) => (
            <div key={k}>
              <dt dangerouslySetInnerHTML={{ __html: label }} />
              <dd dangerouslySetInnerHTML={{ __html: value }} />
            </div>
          ))}
        </dl>
      );
    case "code":
      return <Code text={block.text} />;
  }
}

function Table({ block }: { block: Extract<Block, { kind: "table" }> }) {
  return (
    <div class="table-box" tabIndex={0} role="group" aria-label={`Table: ${wordsOf(block.caption)}`}>
      <table>
        <caption dangerouslySetInnerHTML={{ __html: block.caption }} />
        <thead>
          <tr>
            {block.head.map((cell, k) =>
              cell ? <th key={k} scope="col" aria-label={cell.includes("<math") ? wordsOf(cell) : undefined} dangerouslySetInnerHTML={{ __html: cell }} /> : <td key={k} />,
            )}
          </tr>
        </thead>
        <tbody>
          {block.rows.map((row, k) => (
            <tr key={k}>
              {row.map((cell, j) => (
                <td key={j} dangerouslySetInnerHTML={{ __html: cell }} />
              ))}
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

/** `copied` is the whole text where not all of it is shown. */
export function Code({ text, label = "code", copied = text }: { text: string; label?: string; copied?: string }) {
  return (
    <div class="code-box">
      <pre tabIndex={0} role="group" aria-label={label}>
        <code>{text}</code>
      </pre>
      <CopyButton label={`Copy ${label}`} bare small text={() => copied} />
    </div>
  );
}
