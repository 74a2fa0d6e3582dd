//! What this process used: processor time and memory.

use serde::Serialize;

/// Resources used since the program started; `None` where the system does not tell.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub(crate) struct Usage {
    /// Processor time of all threads in the program itself, in seconds.
    pub(crate) user_seconds: Option<f64>,
    /// Processor time that the system spent for it, in seconds.
    pub(crate) system_seconds: Option<f64>,
    /// Sum of both.
    pub(crate) cpu_seconds: Option<f64>,
    /// Most memory in use at any time, in bytes.
    pub(crate) peak_memory_bytes: Option<u64>,
}

impl Usage {
    /// What was used up to now.
    #[cfg(unix)]
    pub(crate) fn now() -> Usage {
        use nix::sys::resource::{UsageWho, getrusage};
        use nix::sys::time::TimeVal;
        let Ok(used) = getrusage(UsageWho::RUSAGE_SELF) else { return Usage::default() };
        let seconds = |t: TimeVal| t.tv_sec() as f64 + 1e-6 * t.tv_usec() as f64;
        let (user, system) = (seconds(used.user_time()), seconds(used.system_time()));
        // getrusage counts kibibytes, but on Apple's systems bytes.
        let unit = if cfg!(target_vendor = "apple") { 1 } else { 1024 };
        let rusage_peak = u64::try_from(used.max_rss()).ok().map(|v| v * unit);
        Usage {
            user_seconds: Some(user),
            system_seconds: Some(system),
            cpu_seconds: Some(user + system),
            // On Linux getrusage also counts what the process was before it became this program.
            peak_memory_bytes: proc_bytes("/proc/self/status", "VmHWM:").or(rusage_peak),
        }
    }

    /// What was used up to now: this system is not asked yet.
    #[cfg(not(unix))]
    pub(crate) fn now() -> Usage {
        Usage::default()
    }
}

/// Memory that could be taken without swapping, in bytes; Linux only.
pub(crate) fn available_memory() -> Option<u64> {
    proc_bytes("/proc/meminfo", "MemAvailable:")
}

/// A line `KEY number kB` of one of Linux's status files.
fn proc_bytes(file: &str, key: &str) -> Option<u64> {
    let text = std::fs::read_to_string(file).ok()?;
    let line = text.lines().find_map(|l| l.strip_prefix(key))?;
    let kib: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    kib.checked_mul(1024)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(target_os = "linux")]
    fn linux_tells_everything() {
        let block = vec![1u8; 64 << 20];
        // Held until its memory has been counted.
        std::hint::black_box(&block);
        let u = Usage::now();
        assert!(u.peak_memory_bytes.unwrap() >= block.len() as u64, "{u:?}");
        assert!(u.cpu_seconds.unwrap() > 0.0, "{u:?}");
        assert!(available_memory().unwrap() > 1 << 20);
    }
}
