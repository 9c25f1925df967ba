// All tests of the page, in one browser: `node --test tests/all.mjs`.
import "./figures.mjs";
import "./robots.mjs";
import "./tree.mjs";
import "./meshes.mjs";
import "./table.mjs";
import "./steps.mjs";
import "./joints.mjs";
import "./hand.mjs";
import "./formulas.mjs";
import "./path.mjs";
import "./weight.mjs";
import "./check.mjs";
import "./share.mjs";
import "./input.mjs";
import "./export.mjs";
import "./access.mjs";
