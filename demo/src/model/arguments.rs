//! What a statement is called with, as the module it calls wants it.

use super::affine::{Affine, Vector};
use super::refusal::Fault;
use super::syntax::{Argument, Statement, Value};

/// The arguments of a statement.
#[derive(Clone, Copy, Debug)]
pub struct Arguments<'s, 't> {
    statement: &'s Statement<'t>,
    names: &'static [&'static str],
}

/// What every module may be told, though it says nothing of the solid, or only of its facets.
const ANYWHERE: [&str; 5] = ["$fn", "$fa", "$fs", "convexity", "timestamp"];

impl<'s, 't> Arguments<'s, 't> {
    /// The arguments of a statement whose module has parameters of these names, in this order.
    ///
    /// # Errors
    /// Where an argument is none of them: what is not understood must not be left out.
    pub fn of(statement: &'s Statement<'t>, names: &'static [&'static str]) -> Result<Self, Fault> {
        let mut places = 0;
        for argument in &statement.arguments {
            match argument.name {
                Some(name) if names.contains(&name) || ANYWHERE.contains(&name) => {}
                Some(name) => {
                    let wanted = format!("`{}` has {}", statement.name, listed(names));
                    return Err(Fault::new(argument.at, format!("`{name}`"), wanted));
                }
                None => {
                    places += 1;
                    if places > names.len() {
                        let wanted = format!("`{}` takes no more arguments than {}", statement.name, listed(names));
                        return Err(Fault::new(argument.at, "one more argument", wanted));
                    }
                }
            }
        }
        Ok(Self { statement, names })
    }

    /// The statement.
    #[must_use]
    pub const fn statement(&self) -> &'s Statement<'t> {
        self.statement
    }

    fn find(&self, name: &str) -> Option<&'s Argument<'t>> {
        let arguments = &self.statement.arguments;
        let by_name = arguments.iter().rfind(|argument| argument.name == Some(name));
        let place = self.names.iter().position(|known| *known == name);
        let by_place = || arguments.iter().filter(|argument| argument.name.is_none()).nth(place?);
        by_name.or_else(by_place).filter(|argument| argument.value != Value::Undefined)
    }

    /// A finite number, or what it is where nothing is said.
    ///
    /// # Errors
    /// Where it is something else.
    pub fn number(&self, name: &str, default: f64) -> Result<f64, Fault> {
        self.find(name).map_or(Ok(default), |argument| match &argument.value {
            Value::Number(number) => finite(argument.at, *number),
            other => Err(refused(argument.at, other, &format!("`{name}` is a number"))),
        })
    }

    /// Whether something is so; it is not where nothing is said.
    ///
    /// # Errors
    /// Where it is neither.
    pub fn truth(&self, name: &str) -> Result<bool, Fault> {
        self.find(name).map_or(Ok(false), |argument| match &argument.value {
            Value::Truth(truth) => Ok(*truth),
            other => Err(refused(argument.at, other, &format!("`{name}` is `true` or `false`"))),
        })
    }

    /// Three numbers, or one for all three.
    ///
    /// # Errors
    /// Where it is something else.
    pub fn size(&self, name: &str) -> Result<Vector, Fault> {
        self.find(name).map_or(Ok([1.0; 3]), |argument| match &argument.value {
            Value::Number(number) => Ok([finite(argument.at, *number)?; 3]),
            other => vector(argument.at, other, &format!("`{name}` is a number or three in brackets")),
        })
    }

    /// The colour of three numbers from 0 to 1, or four; `None` where one is negative, by which OpenSCAD says that there is none.
    ///
    /// # Errors
    /// Where it is something else.
    pub fn colour(&self, name: &str) -> Result<Option<Vector>, Fault> {
        let wanted = "a colour is three or four numbers from 0 to 1 in brackets";
        self.find(name).map_or(Ok(None), |argument| {
            let of = match &argument.value {
                Value::Vector(parts) if parts.len() == 4 => &Value::Vector(parts[..3].to_vec()),
                other => other,
            };
            let colour = vector(argument.at, of, wanted)?;
            Ok(colour.iter().all(|channel| *channel >= 0.0).then_some(colour))
        })
    }

    /// A list of points.
    ///
    /// # Errors
    /// Where it is missing or something else.
    pub fn points(&self, name: &str) -> Result<Vec<Vector>, Fault> {
        let (at, items) = self.list(name, "points: vectors of three numbers")?;
        items.iter().map(|point| vector(at, point, "a point is three numbers in brackets")).collect()
    }

    /// A list of lists of numbers of points, of which there are so many.
    ///
    /// # Errors
    /// Where it is missing or something else, or there is no such point.
    pub fn faces(&self, name: &str, points: usize) -> Result<Vec<Vec<usize>>, Fault> {
        let (at, items) = self.list(name, "faces: vectors of numbers of points")?;
        let number = |value: &Value<'_>| match value {
            Value::Number(number) if number.fract() == 0.0 && (0.0..points as f64).contains(number) => Ok(*number as usize),
            other => Err(refused(at, other, &format!("there are points from 0 to {}", points.saturating_sub(1)))),
        };
        let face = |value: &Value<'_>| match value {
            Value::Vector(numbers) if numbers.len() >= 3 => numbers.iter().map(number).collect(),
            other => Err(refused(at, other, "a face is three or more numbers of points in brackets")),
        };
        items.iter().map(face).collect()
    }

    fn list(&self, name: &str, what: &str) -> Result<(usize, &'s [Value<'t>]), Fault> {
        let statement = self.statement;
        match self.find(name) {
            Some(Argument {
                at,
                value: Value::Vector(items),
                ..
            }) => Ok((*at, items)),
            Some(Argument { at, value, .. }) => Err(refused(*at, value, &format!("`{name}` is a vector of {what}"))),
            None => Err(Fault::new(
                statement.at,
                format!("`{}` without `{name}`", statement.name),
                format!("it needs a vector of {what}"),
            )),
        }
    }

    /// A matrix of three rows of four numbers, and a fourth that is `[0, 0, 0, 1]` or left out.
    ///
    /// # Errors
    /// Where it is missing or something else.
    pub fn matrix(&self, name: &str) -> Result<Affine, Fault> {
        let (at, rows) = self.list(name, "four rows of four numbers")?;
        let wanted = "a matrix is four rows of four numbers, the last of them [0, 0, 0, 1]";
        let row = |value: &Value<'_>| match value {
            Value::Vector(row) if row.len() == 4 => {
                let mut numbers = [0.0; 4];
                for (number, value) in numbers.iter_mut().zip(row) {
                    *number = number_of(at, value, wanted)?;
                }
                Ok(numbers)
            }
            other => Err(refused(at, other, wanted)),
        };
        let rows: Vec<[f64; 4]> = rows.iter().map(row).collect::<Result<_, _>>()?;
        match rows[..] {
            [x, y, z] | [x, y, z, [0.0, 0.0, 0.0, 1.0]] => Ok(Affine {
                linear: [x, y, z].map(|[a, b, c, _]| [a, b, c]),
                translation: [x[3], y[3], z[3]],
            }),
            _ => Err(Fault::new(at, "another matrix", wanted)),
        }
    }
}

fn listed(names: &[&str]) -> String {
    if names.is_empty() {
        return "no arguments".to_owned();
    }
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

fn finite(at: usize, number: f64) -> Result<f64, Fault> {
    if number.is_finite() {
        Ok(number)
    } else {
        Err(Fault::new(at, number.to_string(), "numbers must be finite"))
    }
}

fn number_of(at: usize, value: &Value<'_>, wanted: &str) -> Result<f64, Fault> {
    match value {
        Value::Number(number) => finite(at, *number),
        other => Err(refused(at, other, wanted)),
    }
}

fn vector(at: usize, value: &Value<'_>, wanted: &str) -> Result<Vector, Fault> {
    match value {
        Value::Vector(parts) => match &parts[..] {
            [x, y, z] => Ok([number_of(at, x, wanted)?, number_of(at, y, wanted)?, number_of(at, z, wanted)?]),
            _ => Err(refused(at, value, wanted)),
        },
        _ => Err(refused(at, value, wanted)),
    }
}

/// The refusal of a value, of which not all may fit into a line.
fn refused(at: usize, value: &Value<'_>, wanted: &str) -> Fault {
    let found = match value {
        Value::Number(number) => number.to_string(),
        Value::Truth(truth) => format!("`{truth}`"),
        Value::Text(_) => "a text".to_owned(),
        Value::Undefined => "`undef`".to_owned(),
        Value::Vector(parts) => format!("a vector of length {}", parts.len()),
    };
    Fault::new(at, found, wanted)
}
