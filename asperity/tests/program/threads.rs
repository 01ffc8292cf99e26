//! A run on several threads.

use serde_json::Value;

use crate::folder_with;

/// The auxiliary runs of the first scene require twice as many angles as they start from, so a main run that has begun
/// beside them is repeated; those of the second do not.
#[test]
fn threads_change_no_number() {
    for (interference, accuracy, sectors) in [(0.05, 0.02, 8), (5.0, 0.5, 4)] {
        let run = |threads: usize| -> Value {
            let sections = format!(
                "[loading]\nslip_rate = 1\ninterference = {interference}\nslip_distance = 0.3\n\
                 [numerics]\nelements_per_radius = 4\naccuracy = {accuracy}\n"
            );
            let folder = folder_with("scene.toml", &sections);
            let line = format!("run scene.toml -o run.nc --json --quiet --threads {threads}");
            let mut results = folder.done(&line).json();
            results["account"]["wall_time"].take();
            results
        };
        let [one, many] = [1, 4].map(run);
        assert_eq!(one, many);
        assert_eq!(one["account"]["sectors"], sectors);
    }
}
