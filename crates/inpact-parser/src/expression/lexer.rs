//! Tokens of a logical line: names, numbers, texts, operators.
//!
//! Never fails: invalid text is a token too, and the parser reports it.

use super::arithmetic::Operator;
use std::ops::Range;

/// Kinds of tokens.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Token {
    /// A letter or underscore, then letters, digits, underscores.
    Name,
    /// Digits.
    Integer,
    /// Digits with a point or an exponent.
    Real,
    /// A malformed number: `1.d0`, `2x`, `1.2.3`.
    MalformedNumber,
    /// `'…'` or `"…"`.
    Text,
    /// A quote that does not close.
    UnterminatedText,
    /// An operator.
    Operator(Operator),
    /// `(`
    Open,
    /// `)`
    Close,
    /// `,`
    Comma,
    /// `=`
    Assign,
    /// `+=` and its like.
    AssignWithOperator,
    /// `==`
    Equal,
    /// `;`
    Semicolon,
    /// Any other character.
    Unknown,
    /// The end of the line.
    End,
}

/// Splits a logical line, without comments, into tokens.
#[derive(Debug)]
pub(super) struct Lexer<'text> {
    text: &'text [u8],
    at: usize,
}

impl<'text> Lexer<'text> {
    /// Begins at `text[from..]`.
    pub(super) fn new(text: &'text [u8], from: usize) -> Self {
        Self { text, at: from }
    }

    /// The next token and its place; always [`Token::End`] at the end.
    pub(super) fn next_token(&mut self) -> (Token, Range<usize>) {
        self.skip_while(is_blank);
        let start = self.at;
        let token = match self.peek(0) {
            None => Token::End,
            Some(b'a'..=b'z' | b'A'..=b'Z' | b'_') => {
                self.skip_while(is_name_byte);
                Token::Name
            }
            Some(b'0'..=b'9') => self.number(),
            Some(b'.') if self.peek(1).is_some_and(|byte| byte.is_ascii_digit()) => self.number(),
            Some(quote @ (b'\'' | b'"')) => self.text(quote),
            Some(first) => self.symbol(first),
        };
        (token, start..self.at)
    }

    fn peek(&self, ahead: usize) -> Option<u8> {
        self.text.get(self.at + ahead).copied()
    }

    fn skip_while(&mut self, accepts: fn(u8) -> bool) {
        let length = self.text[self.at..].iter().position(|byte| !accepts(*byte));
        self.at = length.map_or(self.text.len(), |length| self.at + length);
    }

    fn number(&mut self) -> Token {
        let is_digit = |byte: u8| byte.is_ascii_digit();
        let mut token = Token::Integer;
        self.skip_while(is_digit);
        if self.peek(0) == Some(b'.') {
            token = Token::Real;
            self.at += 1;
            self.skip_while(is_digit);
        }
        if matches!(self.peek(0), Some(b'e' | b'E')) && self.skip_exponent() {
            token = Token::Real;
        }
        match self.peek(0) {
            Some(byte) if is_name_byte(byte) || byte == b'.' || byte >= 0x80 => {
                if matches!(byte, b'd' | b'D') {
                    self.skip_exponent();
                }
                self.skip_while(|byte| is_name_byte(byte) || byte == b'.' || byte >= 0x80);
                Token::MalformedNumber
            }
            _ => token,
        }
    }

    /// Consumes the exponent whose letter is here; `false` when no digit follows.
    fn skip_exponent(&mut self) -> bool {
        let digits = if matches!(self.peek(1), Some(b'+' | b'-')) { 2 } else { 1 };
        let has_digits = self.peek(digits).is_some_and(|byte| byte.is_ascii_digit());
        if has_digits {
            self.at += digits;
            self.skip_while(|byte| byte.is_ascii_digit());
        }
        has_digits
    }

    fn text(&mut self, quote: u8) -> Token {
        self.at += 1;
        while let Some(byte) = self.peek(0) {
            self.at += if byte == b'\\' { 2 } else { 1 };
            if byte == quote {
                return Token::Text;
            }
        }
        self.at = self.text.len();
        Token::UnterminatedText
    }

    fn symbol(&mut self, first: u8) -> Token {
        let (token, length) = match (first, self.peek(1)) {
            (b'*', Some(b'*')) => (Token::Operator(Operator::Power), 2),
            (b'/', Some(b'/')) => (Token::Operator(Operator::FloorDivide), 2),
            (b'=', Some(b'=')) => (Token::Equal, 2),
            (b'+', _) => (Token::Operator(Operator::Add), 1),
            (b'-', _) => (Token::Operator(Operator::Subtract), 1),
            (b'*', _) => (Token::Operator(Operator::Multiply), 1),
            (b'/', _) => (Token::Operator(Operator::Divide), 1),
            (b'%', _) => (Token::Operator(Operator::Remainder), 1),
            (b'(', _) => (Token::Open, 1),
            (b')', _) => (Token::Close, 1),
            (b',', _) => (Token::Comma, 1),
            (b'=', _) => (Token::Assign, 1),
            (b';', _) => (Token::Semicolon, 1),
            _ => (Token::Unknown, self.character_length()),
        };
        self.at += length;
        if matches!(token, Token::Operator(_)) && self.peek(0) == Some(b'=') {
            self.at += 1;
            return Token::AssignWithOperator;
        }
        token
    }

    /// The number of bytes of the character here: one, or those of a UTF-8 character.
    fn character_length(&self) -> usize {
        let following = self.text[self.at + 1..].iter().take(3).take_while(|byte| **byte & 0xC0 == 0x80);
        if self.text[self.at] < 0xC0 { 1 } else { 1 + following.count() }
    }
}

/// Whether a byte is white space.
pub(super) fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\x0C')
}

/// Whether a byte may occur in a name after its first.
pub(super) fn is_name_byte(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_'
}

/// Whether a text is a name that a statement may define: a letter, then letters, digits, underscores (S-60); Python adds the underscore in front.
pub fn is_parameter_name(text: &[u8]) -> bool {
    text.first().is_some_and(|byte| !byte.is_ascii_digit()) && text.iter().all(|byte| is_name_byte(*byte))
}
