//! The tokens of C, comments and directives left out.

use crate::code::lexer::{Mark, Token};
use crate::code::tree::Span;
use denavit_symbolic::Rational;

/// The most tokens of a program.
const MAX_TOKENS: usize = 200_000;
/// Longer ones first.
const OPS: &[&str] = &[
    "<<=", ">>=", "->", "::", "&&", "||", "==", "!=", "<=", ">=", "+=", "-=", "*=", "/=", "++", "--", "<<",
    ">>", "+", "-", "*", "/", "%", "&", "|", "^", "~", "!", "<", ">", "(", ")", "[", "]", "{", "}", ",", ":",
    ".", ";", "=", "?",
];
/// The tokens of C; a `#define` becomes `NAME = value;`.
pub(super) fn lexed(text: &str, span: &Span) -> Vec<Token> {
    let mut tokens: Vec<Token> = vec![];
    let mut at = span.start;
    let mut is_apart = false;
    let push = |tokens: &mut Vec<Token>, mark: Mark, span: Span, is_apart: &mut bool| {
        tokens.push(Token { mark, span, is_apart: std::mem::take(is_apart) });
    };
    while let Some(rest) = text.get(at..span.end).filter(|r| !r.is_empty()) {
        let Some(c) = rest.chars().next().filter(|_| tokens.len() < MAX_TOKENS) else { break };
        let line = rest.find('\n').unwrap_or(rest.len());
        if c.is_whitespace() {
            (at, is_apart) = (at + c.len_utf8(), true);
        } else if rest.starts_with("//") {
            at += line;
        } else if rest.starts_with("/*") {
            at += rest.find("*/").map_or(rest.len(), |i| i + 2);
        } else if c == '#' {
            let plain = rest[..line].split("//").next().unwrap_or_default();
            let plain = plain.split("/*").next().unwrap_or_default();
            let mut words = plain[1..].split_whitespace();
            if let (Some("define"), Some(name)) = (words.next(), words.next())
                && words.next().is_some()
                && let Some(i) = plain.find(name)
                && !name.contains('(')
            {
                let value = at + i + name.len()..at + plain.trim_end().len();
                push(&mut tokens, Mark::Name(name.into()), at + i..value.start, &mut is_apart);
                push(&mut tokens, Mark::Op("="), value.start..value.start, &mut is_apart);
                tokens.extend(lexed(text, &value));
                push(&mut tokens, Mark::Op(";"), value.end..value.end, &mut is_apart);
            }
            at += line;
        } else if c == '"' || c == '\'' {
            let end = rest[1..].find([c, '\n']).map_or(rest.len(), |i| i + 2).min(rest.len());
            push(&mut tokens, Mark::Text(String::new()), at..at + end, &mut is_apart);
            at += end;
        } else if c.is_ascii_digit() || c == '.' && rest[1..].starts_with(|d: char| d.is_ascii_digit()) {
            let length = number(rest);
            let written = &rest[..length];
            let mark = match Rational::from_decimal(written) {
                Some(r) => Mark::Number(r, !written.contains(['.', 'e', 'E'])),
                None => Mark::Bad("a number of this size is not read".into()),
            };
            push(&mut tokens, mark, at..at + length, &mut is_apart);
            let suffix = rest[length..].chars().take_while(|c| "fFlLuU".contains(*c)).count();
            at += length + suffix;
        } else if c.is_alphabetic() || c == '_' {
            let length = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
            push(&mut tokens, Mark::Name(rest[..length].into()), at..at + length, &mut is_apart);
            at += length;
        } else if let Some(op) = OPS.iter().find(|op| rest.starts_with(**op)) {
            push(&mut tokens, Mark::Op(op), at..at + op.len(), &mut is_apart);
            at += op.len();
        } else {
            push(
                &mut tokens,
                Mark::Bad(format!("`{c}` is not read here")),
                at..at + c.len_utf8(),
                &mut is_apart,
            );
            at += c.len_utf8();
        }
    }
    tokens
}

fn number(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |mut at: usize| {
        while bytes.get(at).is_some_and(u8::is_ascii_digit) {
            at += 1;
        }
        at
    };
    let mut length = digits(0);
    if bytes.get(length) == Some(&b'.') {
        length = digits(length + 1);
    }
    if matches!(bytes.get(length), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(length + 1), Some(b'+' | b'-')));
        let end = digits(length + 1 + sign);
        if end > length + 1 + sign {
            length = end;
        }
    }
    length
}
