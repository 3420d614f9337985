//! How moments are written.

/// A way to write a moment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TimeUnit {
    /// `f 80`.
    #[default]
    Frames,
    /// `2.67 s`.
    Seconds,
    /// `0:02:20`: minutes, seconds and frames, as film cutters count (SMPTE without drop frames).
    Timecode,
}

impl TimeUnit {
    /// All of them, in the order in which they are gone through.
    pub const ALL: [Self; 3] = [Self::Frames, Self::Seconds, Self::Timecode];

    /// What it is remembered by.
    pub fn key(self) -> &'static str {
        match self {
            Self::Frames => "time in frames",
            Self::Seconds => "time in seconds",
            Self::Timecode => "time in timecode",
        }
    }

    /// The one after this.
    pub fn next(self) -> Self {
        match self {
            Self::Frames => Self::Seconds,
            Self::Seconds => Self::Timecode,
            Self::Timecode => Self::Frames,
        }
    }

    /// A frame in words, with its unit.
    pub fn text(self, frame: usize, fps: f64) -> String {
        match self {
            Self::Frames => format!("f {frame}"),
            Self::Seconds => format!("{:.2} s", frame as f64 / fps),
            Self::Timecode => timecode(frame, fps),
        }
    }

    /// A frame as short as on the ruler.
    pub fn short(self, frame: usize, fps: f64) -> String {
        match self {
            Self::Frames => frame.to_string(),
            Self::Seconds => {
                let text = format!("{:.2}", frame as f64 / fps);
                let text = text.trim_end_matches('0').trim_end_matches('.');
                format!("{text} s")
            }
            Self::Timecode => timecode(frame, fps),
        }
    }
}

fn timecode(frame: usize, fps: f64) -> String {
    let per_second = fps.round().max(1.0) as usize;
    let secs = frame / per_second;
    format!("{}:{:02}:{:02}", secs / 60, secs % 60, frame % per_second)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_in_words() {
        for (frame, fps, texts) in [
            (0, 30.0, ["f 0", "0.00 s", "0:00:00"]),
            (80, 30.0, ["f 80", "2.67 s", "0:02:20"]),
            (1859, 30.0, ["f 1859", "61.97 s", "1:01:29"]),
            (24, 23.976, ["f 24", "1.00 s", "0:01:00"]),
            (3, 0.4, ["f 3", "7.50 s", "0:03:00"]),
        ] {
            let units = [TimeUnit::Frames, TimeUnit::Seconds, TimeUnit::Timecode];
            assert_eq!(units.map(|unit| unit.text(frame, fps)), texts);
        }
        assert_eq!(TimeUnit::Seconds.short(45, 30.0), "1.5 s");
        assert_eq!(TimeUnit::Seconds.short(300, 30.0), "10 s");
        assert_eq!(TimeUnit::Timecode.next(), TimeUnit::Frames);
    }
}
