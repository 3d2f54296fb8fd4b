//! Places of the rows of a table in compact form: a deck may hold more rows than anything else.

use crate::span::Span;

/// Spans in the order of rows, stored relative to the keyword line of the table, which the caller must pass each time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RowPlaces {
    rows: Vec<RowPlace>,
    /// Rows in another file than the keyword line, before it, or more than 4 GiB after it.
    elsewhere: Option<Box<Elsewhere>>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct RowPlace {
    /// The bytes between the start of the keyword line and that of the row; [`RowPlace::ELSEWHERE`] for one that is elsewhere.
    offset: u32,
    /// The bytes of the row; the index of one that is elsewhere.
    length: u32,
}

impl RowPlace {
    const ELSEWHERE: u32 = u32::MAX;
}

#[derive(Debug, Clone, PartialEq, Default)]
struct Elsewhere {
    spans: Vec<Span>,
}

impl RowPlaces {
    /// The places of rows of the table of that keyword line.
    pub(super) fn of(spans: impl IntoIterator<Item = Span>, keyword: Span) -> Self {
        let mut places = Self::default();
        spans.into_iter().for_each(|span| places.push(span, keyword));
        places.shrink();
        places
    }

    /// Releases unused capacity.
    pub(super) fn shrink(&mut self) {
        self.rows.shrink_to_fit();
    }

    pub(super) fn reserve_exact(&mut self, rows: usize) {
        self.rows.reserve_exact(rows);
    }

    pub(super) fn push(&mut self, span: Span, keyword: Span) {
        let place = self.place_of(span, keyword);
        self.rows.push(place);
    }

    /// Extends the last row up to the end of `line`, where it begins in the same file.
    pub(super) fn extend_last(&mut self, line: Span, keyword: Span) {
        let last = self.rows.len().checked_sub(1).and_then(|last| self.get(last, keyword));
        if let Some(row) = last.filter(|row| row.source() == line.source()) {
            let place = self.place_of(row.to(line), keyword);
            self.rows.pop();
            self.rows.push(place);
        }
    }

    pub(super) fn get(&self, index: usize, keyword: Span) -> Option<Span> {
        self.rows.get(index).map(|place| self.span(*place, keyword))
    }

    pub(super) fn iter(&self, keyword: Span) -> impl ExactSizeIterator<Item = Span> {
        self.rows.iter().map(move |place| self.span(*place, keyword))
    }

    fn place_of(&mut self, span: Span, keyword: Span) -> RowPlace {
        let offset = span.start().checked_sub(keyword.start()).filter(|_| span.source() == keyword.source());
        let offset =
            offset.and_then(|offset| u32::try_from(offset).ok()).filter(|offset| *offset < RowPlace::ELSEWHERE);
        if let (Some(offset), Ok(length)) = (offset, u32::try_from(span.len())) {
            return RowPlace { offset, length };
        }
        let spans = &mut self.elsewhere.get_or_insert_default().spans;
        spans.push(span);
        // More rows in other files than that of the table do not fit into memory.
        let length = u32::try_from(spans.len() - 1).unwrap_or(u32::MAX);
        RowPlace { offset: RowPlace::ELSEWHERE, length }
    }

    fn span(&self, RowPlace { offset, length }: RowPlace, keyword: Span) -> Span {
        if offset != RowPlace::ELSEWHERE {
            let start = keyword.start() + u64::from(offset);
            return Span::new(keyword.source(), start, start + u64::from(length));
        }
        let spans = self.elsewhere.as_ref().map_or(&[][..], |elsewhere| &elsewhere.spans);
        spans.get(length as usize).copied().unwrap_or(keyword)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::span::SourceId;

    #[test]
    fn every_span_comes_back() {
        let keyword = Span::new(SourceId(3), 1000, 1020);
        let spans = [
            Span::new(SourceId(3), 1020, 1030),
            Span::new(SourceId(3), 1000 + u64::from(u32::MAX) - 1, 1 << 33),
            Span::new(SourceId(3), 1000 + u64::from(u32::MAX), (1 << 33) + 1),
            Span::new(SourceId(3), 1040, (1 << 32) + 1039),
            Span::new(SourceId(3), 1040, (1 << 32) + 1040),
            Span::new(SourceId(3), 0, 5),
            Span::new(SourceId(4), 2000, 2000),
        ];
        let mut places = RowPlaces::default();
        for span in spans {
            places.push(span, keyword);
        }
        assert_eq!(places.iter(keyword).collect::<Vec<_>>(), spans);
        assert_eq!(places.get(spans.len(), keyword), None);
    }

    #[test]
    fn the_last_row_goes_on_in_its_own_file_only() {
        let keyword = Span::new(SourceId(0), 10, 20);
        let mut places = RowPlaces::default();
        places.extend_last(Span::new(SourceId(0), 20, 30), keyword);
        assert_eq!(places.get(0, keyword), None);
        places.push(Span::new(SourceId(0), 20, 30), keyword);
        places.extend_last(Span::new(SourceId(0), 31, 40), keyword);
        places.extend_last(Span::new(SourceId(1), 0, 9), keyword);
        places.push(Span::new(SourceId(1), 10, 19), keyword);
        places.extend_last(Span::new(SourceId(1), 20, 29), keyword);
        let found: Vec<Span> = places.iter(keyword).collect();
        assert_eq!(found, [Span::new(SourceId(0), 20, 40), Span::new(SourceId(1), 10, 29)]);
    }
}
