//! The table: a row a figure, what is to be known about it below.

use motion_bench::stopwatch::Spent;

/// A figure that was measured.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    pub(crate) figure: String,
    /// What is promised.
    pub(crate) target: &'static str,
    pub(crate) measured: String,
    /// Whether the promise is kept.
    pub(crate) is_met: bool,
    /// What measuring took.
    pub(crate) spent: Spent,
    pub(crate) notes: Vec<String>,
}

/// The rows as text, columns as wide as they must be; without verdicts where nothing is promised.
pub(crate) fn render(rows: &[Row], is_promised: bool) -> String {
    let mut cells: Vec<[String; 6]> =
        vec![["figure", "target", "measured", "", "wall s", "CPU s"].map(str::to_owned)];
    cells.extend(rows.iter().map(|row| {
        [
            row.figure.clone(),
            row.target.to_owned(),
            row.measured.clone(),
            match row.is_met {
                _ if !is_promised => String::new(),
                true => "met".to_owned(),
                false => "MISSED".to_owned(),
            },
            format!("{:.2}", row.spent.wall.as_secs_f64()),
            format!("{:.2}", row.spent.cpu.as_secs_f64()),
        ]
    }));
    let width = |column: usize| {
        cells.iter().map(|row| row[column].chars().count()).max().unwrap_or_default()
    };
    let widths: [usize; 6] = std::array::from_fn(width);
    let mut text = String::new();
    for (nth, row) in cells.iter().enumerate() {
        let mut line = String::new();
        for (column, (cell, &width)) in row.iter().zip(&widths).enumerate() {
            let is_number = column >= 4;
            let cell =
                if is_number { format!("{cell:>width$}") } else { format!("{cell:<width$}") };
            line = line + &cell + "  ";
        }
        text = text + line.trim_end() + "\n";
        let notes = nth.checked_sub(1).map_or(&[][..], |nth| &rows[nth].notes);
        for note in notes {
            text = text + "    " + note + "\n";
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn columns_are_as_wide_as_their_widest_cell() {
        let spent = Spent { wall: Duration::from_millis(1500), cpu: Duration::from_millis(12_000) };
        let row = |figure: &str, is_met, notes: &[&str]| Row {
            figure: figure.to_owned(),
            target: "1 s",
            measured: "0.9 s".to_owned(),
            is_met,
            spent,
            notes: notes.iter().map(|&note| note.to_owned()).collect(),
        };
        let text = render(&[row("a", true, &["why"]), row("longer", false, &[])], true);
        let expected = "\
figure  target  measured          wall s  CPU s
a       1 s     0.9 s     met       1.50  12.00
    why
longer  1 s     0.9 s     MISSED    1.50  12.00
";
        assert_eq!(text, expected);
    }
}
