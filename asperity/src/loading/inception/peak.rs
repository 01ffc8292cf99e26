//! The largest friction up to sliding inception, and whether the contact slips as a whole from there.

use crate::loading::state::SlideState;

/// Shortest part of the slip over which a slope counts: in shorter increments Q is not smooth. The increment in which sliding
/// begins is at least 1.2 times as long.
const SPAN: f64 = 0.004;

/// Number of the state of largest friction before the last state of `history`: among those up to `slip`, or all if friction then
/// falls at once. None if `friction`, that at `slip`, is larger.
pub fn peak(history: &[SlideState], slip: f64, friction: f64) -> Option<usize> {
    let (_, earlier) = history.split_last()?;
    let largest = |before: f64| {
        let found = (1..earlier.len()).filter(|&m| earlier[m].slip < before);
        found.max_by(|&a, &b| earlier[a].friction.total_cmp(&earlier[b].friction))
    };
    let at_once = largest(f64::INFINITY).filter(|&m| falls_at_once(history, m));
    let found = at_once.or_else(|| largest(slip));
    found.filter(|&m| earlier[m].friction > friction)
}

/// Whether friction falls faster from its peak than the contact unloads elastically.
pub fn falls_at_once(history: &[SlideState], peak: usize) -> bool {
    let top = history[peak];
    let elastic = history[1..=peak].iter().map(|state| state.friction / state.slip).fold(0.0, f64::max);
    let falls = |state: &SlideState| top.friction - state.friction > elastic * (state.slip - top.slip);
    history[peak + 1..].iter().any(|state| state.slip - top.slip > SPAN * top.slip && falls(state))
}

/// A state before the peak, far enough from it for a slope.
pub fn rising(history: &[SlideState], peak: usize) -> SlideState {
    let far_enough = |state: &&SlideState| state.slip < (1.0 - SPAN) * history[peak].slip;
    *history[..peak].iter().rfind(far_enough).unwrap_or(&history[0])
}
