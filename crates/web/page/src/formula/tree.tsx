// The tree of a solution: what is found from what, branch by branch.

import type { Tree } from "../engine/types.ts";

export function TreeView({ root }: { root: Tree }) {
  return (
    <ul class="tree" aria-label="Solution tree">
      {/* A root without words only holds the branches together. */}
      {(root.html ? [root] : root.children).map((tree, k) => (
        <Branch key={k} tree={tree} />
      ))}
    </ul>
  );
}

function Branch({ tree }: { tree: Tree }) {
  if (tree.children.length === 0) return <li class="leaf" dangerouslySetInnerHTML={{ __html: tree.html }} />;
  return (
    <li>
      <details open>
        <summary dangerouslySetInnerHTML={{ __html: tree.html }} />
        <ul>
          {tree.children.map((child, k) => (
            <Branch key={k} tree={child} />
          ))}
        </ul>
      </details>
    </li>
  );
}
