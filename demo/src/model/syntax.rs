//! From the text of a `.csg` file to its statements: names, arguments and what stands within what, and no meaning yet.
//!
//! Statements lie in one list, each followed by those within it, so that no depth of nesting is too deep for a stack.

use super::refusal::Fault;
use winnow::ascii::{multispace1, till_line_ending};
use winnow::combinator::{alt, opt, preceded, repeat, terminated};
use winnow::error::{AddContext, ParserError};
use winnow::prelude::*;
use winnow::stream::{LocatingSlice, Location, Stream};
use winnow::token::{any, one_of, take_till, take_until, take_while};

/// A statement: `name(arguments)` and a body, or a semicolon.
#[derive(Clone, Debug, PartialEq)]
pub struct Statement<'t> {
    /// What is called.
    pub name: &'t str,
    /// The byte of the text where the name starts.
    pub at: usize,
    /// The modifiers before it.
    pub modifiers: Modifiers,
    /// What it is called with, in order.
    pub arguments: Vec<Argument<'t>>,
    /// The index of the first statement after it that is not within it.
    pub end: usize,
}

/// The characters before a name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Modifiers {
    /// `%`, or `*`: it is not part of the model.
    pub left_out: bool,
    /// `!`: it alone is the model.
    pub root: bool,
}

/// An argument, by name or by place.
#[derive(Clone, Debug, PartialEq)]
pub struct Argument<'t> {
    /// The name, if there is one.
    pub name: Option<&'t str>,
    /// The byte of the text where it starts.
    pub at: usize,
    /// The value.
    pub value: Value<'t>,
}

/// The value of an argument.
#[derive(Clone, Debug, PartialEq)]
pub enum Value<'t> {
    /// A number, which may be infinite or none.
    Number(f64),
    /// `true` or `false`.
    Truth(bool),
    /// A text in quotes, as it stands between them.
    Text(&'t str),
    /// `undef`.
    Undefined,
    /// Values in brackets.
    Vector(Vec<Value<'t>>),
}

/// How deep brackets may lie in each other: the points of a polyhedron are a vector of vectors.
const MAX_BRACKETS: usize = 8;

type Input<'t> = LocatingSlice<&'t str>;
type Parsed<T> = Result<T, Fault>;

impl<'t> ParserError<Input<'t>> for Fault {
    type Inner = Self;

    fn from_input(input: &Input<'t>) -> Self {
        Self {
            at: input.current_token_start(),
            found: None,
            wanted: String::new(),
        }
    }

    fn into_inner(self) -> Result<Self, Self> {
        Ok(self)
    }
}

impl<'t> AddContext<Input<'t>, &'static str> for Fault {
    fn add_context(mut self, _: &Input<'t>, _: &<Input<'t> as Stream>::Checkpoint, context: &'static str) -> Self {
        // What was wanted innermost says most.
        if self.wanted.is_empty() {
            context.clone_into(&mut self.wanted);
        }
        self
    }
}

/// The statements of a text.
///
/// # Errors
/// Where it is no `.csg`.
pub fn statements(text: &str) -> Result<Vec<Statement<'_>>, Fault> {
    let mut input = Input::new(text);
    let mut statements = Vec::new();
    let mut open: Vec<Open> = Vec::new();
    opt('\u{feff}').parse_next(&mut input)?;
    loop {
        blank(&mut input)?;
        if input.is_empty() {
            break;
        }
        if opt('}').parse_next(&mut input)?.is_some() {
            match open.pop() {
                Some(Open { index, braced: true }) => close(&mut statements, &mut open, index),
                _ => {
                    let at = input.current_token_start() - 1;
                    return Err(Fault::new(at, "`}`", "no `{` is open here: take the brace away, or write a module"));
                }
            }
            continue;
        }
        let index = statements.len();
        statements.push(head(&mut input)?);
        blank(&mut input)?;
        match opt(one_of([';', '{'])).parse_next(&mut input)? {
            Some(';') => close(&mut statements, &mut open, index),
            Some(_) => open.push(Open { index, braced: true }),
            None => {
                // What follows must be the one statement within it.
                let starts = |letter: char| is_of_name(letter) || "%#!*".contains(letter);
                if !input.chars().next().is_some_and(starts) {
                    return Err(wanted(&input, "after a module comes `;`, its children in `{` and `}`, or one child"));
                }
                open.push(Open { index, braced: false });
            }
        }
    }
    match open.pop().and_then(|open| statements.get(open.index)) {
        None => Ok(statements),
        Some(unfinished) => Err(Fault {
            at: text.len(),
            found: None,
            wanted: format!("`{}` of line {} is not closed", unfinished.name, 1 + newlines(text, unfinished.at)),
        }),
    }
}

/// A statement whose end is not yet known.
struct Open {
    index: usize,
    /// Whether a brace ends it, or the end of the one statement within it.
    braced: bool,
}

/// Ends a statement, and those of which it is the only one within.
fn close(statements: &mut [Statement<'_>], open: &mut Vec<Open>, index: usize) {
    let end = statements.len();
    let mut closed = Some(index);
    while let Some(statement) = closed.and_then(|index| statements.get_mut(index)) {
        statement.end = end;
        closed = open.pop_if(|open| !open.braced).map(|open| open.index);
    }
}

fn newlines(text: &str, end: usize) -> usize {
    text.bytes().take(end).filter(|byte| *byte == b'\n').count()
}

fn wanted(input: &Input<'_>, wanted: &str) -> Fault {
    Fault {
        wanted: wanted.to_owned(),
        ..Fault::from_input(input)
    }
}

/// White space and comments.
fn blank(input: &mut Input<'_>) -> Parsed<()> {
    let line = ("//", till_line_ending).void();
    let block = ("/*", take_until(0.., "*/"), "*/").void();
    repeat(0.., alt((multispace1.void(), line, block))).parse_next(input)
}

fn is_of_name(letter: char) -> bool {
    letter.is_ascii_alphanumeric() || letter == '_' || letter == '$'
}

fn name<'t>(input: &mut Input<'t>) -> Parsed<&'t str> {
    let letters = take_while(1.., is_of_name);
    letters.verify(|name: &str| !name.starts_with(|letter: char| letter.is_ascii_digit())).parse_next(input)
}

/// Modifiers, name and arguments.
fn head<'t>(input: &mut Input<'t>) -> Parsed<Statement<'t>> {
    let mut modifiers = Modifiers::default();
    while let Some(modifier) = opt(terminated(one_of(['%', '#', '!', '*']), blank)).parse_next(input)? {
        match modifier {
            '!' => modifiers.root = true,
            '#' => {}
            _ => modifiers.left_out = true,
        }
    }
    let at = input.current_token_start();
    let name = name.context("the name of a module, such as `cube` or `union`").parse_next(input)?;
    blank(input)?;
    '('.context("`(` and the arguments of the module").parse_next(input)?;
    let arguments = list(input, ')', "`,` or `)`", |input| argument(input))?;
    Ok(Statement {
        name,
        at,
        modifiers,
        arguments,
        end: 0,
    })
}

/// Items between commas, up to what closes them.
fn list<'t, T>(
    input: &mut Input<'t>,
    closing: char,
    between: &'static str,
    item: impl Fn(&mut Input<'t>) -> Parsed<T>,
) -> Parsed<Vec<T>> {
    let mut items = Vec::new();
    loop {
        blank(input)?;
        if opt(closing).parse_next(input)?.is_some() {
            return Ok(items);
        }
        items.push(item(input)?);
        blank(input)?;
        if opt(',').parse_next(input)?.is_none() {
            closing.context(between).parse_next(input)?;
            return Ok(items);
        }
    }
}

fn argument<'t>(input: &mut Input<'t>) -> Parsed<Argument<'t>> {
    let at = input.current_token_start();
    let name = opt(terminated(name, (blank, '='))).parse_next(input)?;
    blank(input)?;
    let value = value(input, MAX_BRACKETS)?;
    Ok(Argument { name, at, value })
}

/// A value in which so many brackets may lie in each other.
fn value<'t>(input: &mut Input<'t>, depth: usize) -> Parsed<Value<'t>> {
    if opt('[').parse_next(input)?.is_some() {
        let Some(depth) = depth.checked_sub(1) else {
            return Err(wanted(input, "brackets may lie in each other eight deep at most"));
        };
        return list(input, ']', "`,` or `]`", |input| value(input, depth)).map(Value::Vector);
    }
    alt((quoted, word))
        .context("a value: a number, `true`, `false`, a text in quotes or a vector in brackets")
        .parse_next(input)
}

/// A text in quotes; what is escaped in it stays so.
fn quoted<'t>(input: &mut Input<'t>) -> Parsed<Value<'t>> {
    let plain = take_till(1.., ['"', '\\']).void();
    let escaped = preceded('\\', any).void();
    let inner = repeat::<_, _, (), _, _>(0.., alt((plain, escaped))).take();
    winnow::combinator::delimited('"', inner, '"').map(Value::Text).parse_next(input)
}

/// A number or a word that stands for a value; numbers may be written `inf` and `-nan`, as OpenSCAD does.
fn word<'t>(input: &mut Input<'t>) -> Parsed<Value<'t>> {
    take_while(1.., |letter: char| letter.is_ascii_alphanumeric() || "+-._".contains(letter))
        .verify_map(|word: &str| match word {
            "true" => Some(Value::Truth(true)),
            "false" => Some(Value::Truth(false)),
            "undef" => Some(Value::Undefined),
            number => number.parse().ok().map(Value::Number),
        })
        .parse_next(input)
}

#[cfg(test)]
mod tests {
    use super::{Value, statements};

    fn refusal(text: &str) -> String {
        match statements(text) {
            Ok(read) => panic!("{text:?} is read as {read:?}"),
            Err(fault) => fault.in_text(text).to_string(),
        }
    }

    #[test]
    fn statements_are_followed_by_those_within_them() {
        let text = "// a comment\nunion() {\n\tcube(size = [1, 2.5, -3e-2], center = true);\n%\tgroup();\n}\n*!sphere($fn = 0, r = inf);";
        let read = statements(text).expect("it is a .csg");
        let shape: Vec<_> = read.iter().map(|statement| (statement.name, statement.end)).collect();
        assert_eq!(shape, [("union", 3), ("cube", 2), ("group", 3), ("sphere", 4)]);
        let modifiers: Vec<_> = read.iter().map(|statement| (statement.modifiers.left_out, statement.modifiers.root)).collect();
        assert_eq!(modifiers, [(false, false), (false, false), (true, false), (true, true)]);
        let size = Value::Vector([1.0, 2.5, -0.03].map(Value::Number).to_vec());
        assert_eq!(read[1].arguments[0].name, Some("size"));
        assert_eq!(read[1].arguments[0].value, size);
        assert_eq!(read[1].arguments[1].value, Value::Truth(true));
        assert_eq!(read[3].arguments[1].value, Value::Number(f64::INFINITY));
        assert_eq!(read[0].at, 13);
    }

    #[test]
    fn one_child_needs_no_braces() {
        let read = statements("color([1, 0, 0]) /* red */ multmatrix([[]]) cube(1); sphere();").expect("it is a .csg");
        let ends: Vec<_> = read.iter().map(|statement| statement.end).collect();
        assert_eq!(ends, [3, 3, 3, 4]);
    }

    #[test]
    fn texts_hold_what_they_escape() {
        let read = statements(r#"text(text = "a\"b\\", size = 1);"#).expect("it is a .csg");
        assert_eq!(read[0].arguments[0].value, Value::Text(r#"a\"b\\"#));
    }

    #[test]
    fn refusals_say_where_and_what_would_do() {
        for (text, told) in [
            ("cube(1)", "line 1, column 8: found the end of the file: after a module comes `;`"),
            ("union() {\ncube(1);", "line 2, column 9: found the end of the file: `union` of line 1 is not closed"),
            ("cube(1);\n}", "line 2, column 1: found `}`: no `{` is open"),
            ("cube(size 3);", "line 1, column 6: found `size`: a value"),
            ("cube(3 4);", "line 1, column 8: found `4`: `,` or `)`"),
            ("cube([1, 2);", "line 1, column 11: found `)`: `,` or `]`"),
            ("cube(1.2.3);", "line 1, column 6: found `1.2.3`: a value"),
            ("cube{}", "line 1, column 5: found `{`: `(`"),
            ("7();", "line 1, column 1: found `7`: the name of a module"),
            ("/* cube();", "line 1, column 1: found `/`: the name of a module"),
            ("text(\"abc);", "line 1, column 6: found `\"`: a value"),
        ] {
            let found = refusal(text);
            assert!(found.starts_with(told), "{found}");
        }
    }

    #[test]
    fn hostile_texts_end_in_one_error() {
        let many = 1_000_000;
        for text in ["(", "[", "{", "}", "\"", "cube(", "cube([", "union(){", "union()", "\0", "!", "-"] {
            let found = refusal(&text.repeat(many / text.len()));
            assert!(found.len() < 200, "{found}");
        }
        assert!(refusal(&format!("cube({}", "[".repeat(many))).contains("eight deep"));
    }
}
