//! The processor that the program was compiled for.
//!
//! A processor without an instruction of the program ends it by a signal (SIGILL) at a place that depends on the input.
//! So its instruction sets are compared first, in integers only, and the message is a text that is there already.

use std::ffi::CStr;
use std::io::Write;

/// To be called first in `main`: ends the program with a message where the processor lacks an instruction set that the
/// program was compiled with.
#[inline(never)]
pub fn check_processor() {
    let Some(name) = missing_instruction_set() else { return };
    // One after the other: an array of texts may be copied by the instructions that are missing.
    print(c"error: ");
    print(UNSUITABLE);
    print(name);
    print(REMEDY);
    print(c"\n");
    std::process::exit(1);
}

/// An instruction set that the program was compiled with and the processor lacks.
#[inline(never)]
pub fn missing_instruction_set() -> Option<&'static CStr> {
    missing(instruction_sets())
}

/// What an error says before its name, and after it.
pub const UNSUITABLE: &CStr = c"this program was compiled for a processor with ";
pub const REMEDY: &CStr =
    c", which this one lacks; compile it on this machine with RUSTFLAGS=\"-C target-cpu=native\"";

#[inline(never)]
fn print(text: &CStr) {
    // The end is the same if nothing can be written.
    let _ = std::io::stderr().write_all(text.to_bytes());
}

struct InstructionSet {
    name: &'static CStr,
    /// Whether the program uses it.
    used: bool,
    /// Whether the processor has it.
    present: bool,
    /// Whether it has it by the standard library, which is independent of how this is compiled where a set is not used.
    #[cfg(test)]
    standard: bool,
}

/// The first that the program uses and the processor lacks.
fn missing<const N: usize>(sets: [InstructionSet; N]) -> Option<&'static CStr> {
    let mut sets = sets.into_iter();
    sets.find_map(|set| (set.used && !set.present).then_some(set.name))
}

/// The standard library reports those that the program uses as present without a test; so the processor is asked.
/// Leaves and bits: Intel 64 and IA-32 Architectures Software Developer's Manual, volume 2, CPUID.
#[cfg(target_arch = "x86_64")]
fn instruction_sets() -> [InstructionSet; 14] {
    use raw_cpuid::native_cpuid::cpuid_count;

    macro_rules! set {
        ($name:tt, $present:expr) => {
            InstructionSet {
                name: const {
                    match CStr::from_bytes_with_nul(concat!($name, "\0").as_bytes()) {
                        Ok(name) => name,
                        Err(_) => panic!("a name ends with the only zero"),
                    }
                },
                used: cfg!(target_feature = $name),
                present: $present,
                #[cfg(test)]
                standard: is_x86_feature_detected!($name),
            }
        };
    }

    let newest = cpuid_count(0, 0).eax;
    let basic = cpuid_count(1, 0).ecx;
    let extended = if newest >= 7 { cpuid_count(7, 0).ebx } else { 0 };
    let amd = cpuid_count(0x8000_0001, 0).ecx;
    let has = |register: u32, bit: u32| register >> bit & 1 == 1;
    // The system saves the wider registers (bit 27) in addition to the processor's having them.
    let avx = has(basic, 27) && has(basic, 28);
    [
        set!("sse3", has(basic, 0)),
        set!("ssse3", has(basic, 9)),
        set!("sse4.1", has(basic, 19)),
        set!("sse4.2", has(basic, 20)),
        set!("popcnt", has(basic, 23)),
        set!("movbe", has(basic, 22)),
        set!("lzcnt", has(amd, 5)),
        set!("avx", avx),
        set!("fma", avx && has(basic, 12)),
        set!("avx2", avx && has(extended, 5)),
        set!("bmi1", has(extended, 3)),
        set!("bmi2", has(extended, 8)),
        set!("avx512f", avx && has(extended, 16)),
        set!("avx512vl", avx && has(extended, 31)),
    ]
}

/// Other processors are not asked.
#[cfg(not(target_arch = "x86_64"))]
fn instruction_sets() -> [InstructionSet; 0] {
    []
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_program_uses_must_be_there() {
        let set = |name, used, present| InstructionSet { name, used, present, standard: present };
        assert!(missing([set(c"avx", true, true), set(c"avx2", false, false)]).is_none());
        let sets = [set(c"avx", true, true), set(c"avx2", true, false), set(c"fma", true, false)];
        assert_eq!(missing(sets), Some(c"avx2"));
        assert_eq!(missing(instruction_sets()), None, "this processor runs the test");
    }

    #[test]
    fn the_processor_is_read_as_the_standard_library_reads_it() {
        for set in instruction_sets() {
            assert_eq!(set.present, set.standard, "{:?}", set.name);
        }
    }
}
