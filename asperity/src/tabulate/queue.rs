//! Presses and slides of a table that wait for a thread.

use std::collections::VecDeque;
use std::sync::{Arc, Condvar, Mutex, MutexGuard};

use super::journal::Index;

/// What one thread does at a time.
pub enum Task<P> {
    /// Press to the interference of a row.
    Press {
        row: usize,
    },
    Slide {
        pressed: Arc<P>,
        index: Index,
    },
}

/// Slides come before presses, which keeps few pressed states in memory; each in the order given.
pub struct Queue<P> {
    waiting: Mutex<Waiting<P>>,
    changed: Condvar,
}

struct Waiting<P> {
    presses: VecDeque<usize>,
    slides: VecDeque<(Arc<P>, Index)>,
    /// Presses that are being computed, of which slides will follow.
    pressing: usize,
}

impl<P> Queue<P> {
    /// A queue of these rows.
    pub fn new(rows: Vec<usize>) -> Self {
        let waiting = Waiting { presses: rows.into(), slides: VecDeque::new(), pressing: 0 };
        Self { waiting: Mutex::new(waiting), changed: Condvar::new() }
    }

    /// The next task, once there is one; none when all are taken or the work is `cancelled`. A press must be followed by
    /// [`Queue::pressed`].
    pub fn next(&self, cancelled: impl Fn() -> bool) -> Option<Task<P>> {
        let mut waiting = self.lock();
        while !cancelled() {
            if let Some((pressed, index)) = waiting.slides.pop_front() {
                return Some(Task::Slide { pressed, index });
            }
            if let Some(row) = waiting.presses.pop_front() {
                waiting.pressing += 1;
                return Some(Task::Press { row });
            }
            if waiting.pressing == 0 {
                return None;
            }
            waiting = self.changed.wait(waiting).unwrap_or_else(|poisoned| poisoned.into_inner());
        }
        None
    }

    /// A press has ended, and these slides follow.
    pub fn pressed(&self, slides: impl IntoIterator<Item = (Arc<P>, Index)>) {
        let mut waiting = self.lock();
        waiting.pressing -= 1;
        waiting.slides.extend(slides);
        self.changed.notify_all();
    }

    fn lock(&self) -> MutexGuard<'_, Waiting<P>> {
        self.waiting.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn label(task: Option<Task<u8>>) -> String {
        match task {
            Some(Task::Press { row }) => format!("press {row}"),
            Some(Task::Slide { pressed, index: (i, j) }) => format!("slide {i} {j} of {pressed}"),
            None => "end".into(),
        }
    }

    #[test]
    fn slides_come_before_presses_and_are_waited_for() {
        let queue = Queue::new(vec![3, 5]);
        let next = || label(queue.next(|| false));
        assert_eq!(next(), "press 3");
        let pressed = Arc::new(7);
        queue.pressed([(pressed.clone(), (3, 0)), (pressed, (3, 1))]);
        assert_eq!([next(), next(), next()], ["slide 3 0 of 7", "slide 3 1 of 7", "press 5"]);
        std::thread::scope(|scope| {
            let waits = scope.spawn(next);
            queue.pressed([(Arc::new(8), (5, 0))]);
            assert_eq!(waits.join().unwrap(), "slide 5 0 of 8");
        });
        assert_eq!(next(), "end");
        assert_eq!(label(Queue::new(vec![0]).next(|| true)), "end");
    }
}
