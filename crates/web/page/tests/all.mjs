// All tests of the page, in one browser: `node --test tests/all.mjs`.
import "./robots.mjs";
