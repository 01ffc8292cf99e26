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

/// Name of an instruction set, whether the program uses it and whether the processor has it.
type InstructionSet = (&'static CStr, bool, bool);

/// The first that the program uses and the processor lacks.
fn missing<const N: usize>(sets: [InstructionSet; N]) -> Option<&'static CStr> {
    let mut sets = sets.into_iter();
    sets.find_map(|(name, used, present)| (used && !present).then_some(name))
}

/// The standard library reports those that the program uses as present without a test; so the processor is asked.
/// Leaves and bits: Intel 64 and IA-32 Architectures Software Developer's Manual, volume 2, CPUID.
#[cfg(target_arch = "x86_64")]
fn instruction_sets() -> [InstructionSet; 14] {
    use raw_cpuid::native_cpuid::cpuid_count;

    let newest = cpuid_count(0, 0).eax;
    let basic = cpuid_count(1, 0).ecx;
    let extended = if newest >= 7 { cpuid_count(7, 0).ebx } else { 0 };
    let amd = cpuid_count(0x8000_0001, 0).ecx;
    let has = |register: u32, bit: u32| register >> bit & 1 == 1;
    // The system saves the wider registers (bit 27) in addition to the processor's having them.
    let avx = has(basic, 27) && has(basic, 28);
    [
        (c"sse3", cfg!(target_feature = "sse3"), has(basic, 0)),
        (c"ssse3", cfg!(target_feature = "ssse3"), has(basic, 9)),
        (c"sse4.1", cfg!(target_feature = "sse4.1"), has(basic, 19)),
        (c"sse4.2", cfg!(target_feature = "sse4.2"), has(basic, 20)),
        (c"popcnt", cfg!(target_feature = "popcnt"), has(basic, 23)),
        (c"movbe", cfg!(target_feature = "movbe"), has(basic, 22)),
        (c"lzcnt", cfg!(target_feature = "lzcnt"), has(amd, 5)),
        (c"avx", cfg!(target_feature = "avx"), avx),
        (c"fma", cfg!(target_feature = "fma"), avx && has(basic, 12)),
        (c"avx2", cfg!(target_feature = "avx2"), avx && has(extended, 5)),
        (c"bmi1", cfg!(target_feature = "bmi1"), has(extended, 3)),
        (c"bmi2", cfg!(target_feature = "bmi2"), has(extended, 8)),
        (c"avx512f", cfg!(target_feature = "avx512f"), avx && has(extended, 16)),
        (c"avx512vl", cfg!(target_feature = "avx512vl"), avx && has(extended, 31)),
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
        assert_eq!(missing([(c"avx", true, true), (c"avx2", false, false)]), None);
        assert_eq!(
            missing([(c"avx", true, true), (c"avx2", true, false), (c"fma", true, false)]),
            Some(c"avx2")
        );
        assert_eq!(missing(instruction_sets()), None, "this processor runs the test");
    }

    /// The names and bits agree with those of the standard library, which are independent of how this is compiled where
    /// a set is not used.
    #[cfg(target_arch = "x86_64")]
    #[test]
    fn the_processor_is_read_as_the_standard_library_reads_it() {
        let standard = [
            is_x86_feature_detected!("sse3"),
            is_x86_feature_detected!("ssse3"),
            is_x86_feature_detected!("sse4.1"),
            is_x86_feature_detected!("sse4.2"),
            is_x86_feature_detected!("popcnt"),
            is_x86_feature_detected!("movbe"),
            is_x86_feature_detected!("lzcnt"),
            is_x86_feature_detected!("avx"),
            is_x86_feature_detected!("fma"),
            is_x86_feature_detected!("avx2"),
            is_x86_feature_detected!("bmi1"),
            is_x86_feature_detected!("bmi2"),
            is_x86_feature_detected!("avx512f"),
            is_x86_feature_detected!("avx512vl"),
        ];
        for ((name, _, present), standard) in instruction_sets().into_iter().zip(standard) {
            assert_eq!(present, standard, "{name:?}");
        }
    }
}
