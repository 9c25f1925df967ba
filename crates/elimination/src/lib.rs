//! All configurations of any six-joint arm at a pose, by elimination.
