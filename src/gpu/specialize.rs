//! Shaders without what is switched off.
//!
//! A device's compiler would drop a branch behind a constant condition too, but only after it has translated and inlined all of it,
//! which takes most of the time that a pipeline takes. So the branches go before it sees them:
//!
//! 1. naga puts the values of the switches in and leaves one entry point,
//! 2. branches whose condition is constant by then are resolved, in the order in which statements run,
//! 3. naga removes what nothing refers to any more.

use std::collections::HashMap;

use wgpu::naga::back::pipeline_constants::process_overrides;
use wgpu::naga::compact::{KeepUnused, compact};
use wgpu::naga::valid::ModuleInfo;
use wgpu::naga::{
    Arena, BinaryOperator, Block, Constant, Expression, Function, Handle, Literal, LocalVariable, Module,
    ShaderStage, Statement, UnaryOperator,
};

/// One entry point of a valid module with its boolean `override` constants set and all that is unreachable then removed. The module
/// has no overrides any more.
///
/// # Errors
/// In words: a constant that the module does not have, or a value that makes it invalid.
pub(super) fn specialized(
    module: &Module,
    info: &ModuleInfo,
    stage: ShaderStage,
    entry_point: &str,
    constants: &[(&str, f64)],
) -> Result<Module, String> {
    let values = constants.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
    let (module, _info) = process_overrides(module, info, Some((stage, entry_point)), &values)
        .map_err(|error| error.to_string())?;
    let mut module = module.into_owned();
    let Module { functions, entry_points, constants, global_expressions, .. } = &mut module;
    let bodies = functions.iter_mut().map(|(_, function)| function);
    for function in bodies.chain(entry_points.iter_mut().map(|entry| &mut entry.function)) {
        let body = std::mem::take(&mut function.body);
        function.body = Resolver::new(function, constants, global_expressions).block(body);
        // Some name what is gone.
        function.named_expressions.clear();
    }
    compact(&mut module, KeepUnused::No);
    Ok(module)
}

/// Resolves the branches of one function.
struct Resolver<'a> {
    function: &'a Function,
    constants: &'a Arena<Constant>,
    global_expressions: &'a Arena<Expression>,
    /// What is known of variables at the statement that is being looked at.
    variables: HashMap<Handle<LocalVariable>, bool>,
    /// What was known where variables were read.
    reads: HashMap<Handle<Expression>, bool>,
}

impl<'a> Resolver<'a> {
    fn new(
        function: &'a Function,
        constants: &'a Arena<Constant>,
        global_expressions: &'a Arena<Expression>,
    ) -> Self {
        Self { function, constants, global_expressions, variables: HashMap::new(), reads: HashMap::new() }
    }

    /// The value of an expression, if it is the same whatever the inputs are.
    fn value(&self, expression: Handle<Expression>) -> Option<bool> {
        match self.function.expressions[expression] {
            Expression::Literal(Literal::Bool(value)) => Some(value),
            Expression::Constant(constant) => match self.global_expressions[self.constants[constant].init] {
                Expression::Literal(Literal::Bool(value)) => Some(value),
                _ => None,
            },
            Expression::Unary { op: UnaryOperator::LogicalNot, expr } => Some(!self.value(expr)?),
            Expression::Binary { op, left, right } => {
                let sides = [self.value(left), self.value(right)];
                match op {
                    BinaryOperator::LogicalAnd if sides.contains(&Some(false)) => Some(false),
                    BinaryOperator::LogicalOr if sides.contains(&Some(true)) => Some(true),
                    BinaryOperator::LogicalAnd => Some(sides[0]? && sides[1]?),
                    BinaryOperator::LogicalOr => Some(sides[0]? || sides[1]?),
                    _ => None,
                }
            }
            Expression::Load { .. } => self.reads.get(&expression).copied(),
            _ => None,
        }
    }

    /// The variable that a pointer points to as a whole.
    fn variable(&self, pointer: Handle<Expression>) -> Option<Handle<LocalVariable>> {
        match self.function.expressions[pointer] {
            Expression::LocalVariable(variable) => Some(variable),
            _ => None,
        }
    }

    fn block(&mut self, block: Block) -> Block {
        let mut resolved = Block::with_capacity(block.len());
        for (statement, span) in block.span_into_iter() {
            match statement {
                Statement::If { condition, accept, reject } => match self.value(condition) {
                    Some(holds) => {
                        let mut taken = self.block(if holds { accept } else { reject });
                        resolved.append(&mut taken);
                    }
                    None => {
                        let before = self.variables.clone();
                        let accept = self.block(accept);
                        self.variables = before;
                        let reject = self.block(reject);
                        self.variables.clear();
                        resolved.push(Statement::If { condition, accept, reject }, span);
                    }
                },
                Statement::Block(inner) => {
                    let inner = self.block(inner);
                    resolved.push(Statement::Block(inner), span);
                    self.variables.clear();
                }
                Statement::Loop { body, continuing, break_if } => {
                    // What was known before it may be wrong the second time.
                    self.variables.clear();
                    let body = self.block(body);
                    self.variables.clear();
                    let continuing = self.block(continuing);
                    self.variables.clear();
                    resolved.push(Statement::Loop { body, continuing, break_if }, span);
                }
                Statement::Switch { selector, mut cases } => {
                    for case in &mut cases {
                        self.variables.clear();
                        case.body = self.block(std::mem::take(&mut case.body));
                    }
                    self.variables.clear();
                    resolved.push(Statement::Switch { selector, cases }, span);
                }
                other => {
                    self.follow(&other);
                    resolved.push(other, span);
                }
            }
            // What follows is not reached, and nothing may follow.
            if resolved.last().is_some_and(Statement::is_terminator) {
                break;
            }
        }
        resolved
    }

    /// Notes what a statement without blocks does to what is known.
    fn follow(&mut self, statement: &Statement) {
        match statement {
            Statement::Emit(range) => {
                for expression in range.clone() {
                    if let Expression::Load { pointer } = self.function.expressions[expression]
                        && let Some(variable) = self.variable(pointer)
                        && let Some(value) = self.variables.get(&variable)
                    {
                        self.reads.insert(expression, *value);
                    }
                }
            }
            Statement::Store { pointer, value } => match (self.variable(*pointer), self.value(*value)) {
                (Some(variable), Some(value)) => {
                    self.variables.insert(variable, value);
                }
                (Some(variable), None) => {
                    self.variables.remove(&variable);
                }
                (None, _) => {}
            },
            // It may have been given a pointer.
            Statement::Call { .. } => self.variables.clear(),
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use wgpu::naga::back::wgsl::{WriterFlags, write_string};
    use wgpu::naga::front::wgsl;
    use wgpu::naga::valid::{Capabilities, ValidationFlags, Validator};

    use super::*;
    use crate::gpu::Shaders;

    fn checked(module: &Module) -> ModuleInfo {
        Validator::new(ValidationFlags::all(), Capabilities::all())
            .validate(module)
            .unwrap_or_else(|error| panic!("{error:?}\n{module:#?}"))
    }

    const TEXT: &str = "
        override A: bool;
        override B: bool;
        var<storage, read_write> out: array<u32>;
        var<storage, read> only_a: array<u32>;
        var<storage, read> only_b: array<u32>;
        fn of_a(i: u32) -> u32 { return only_a[i] + 1000u; }
        fn of_b(i: u32) -> u32 { return only_b[i] + 2000u; }
        fn early(i: u32) -> u32 {
            if !A { return 5u; }
            return of_a(i);
        }
        @compute @workgroup_size(1)
        fn cs_main(@builtin(global_invocation_id) id: vec3<u32>) {
            let i = id.x;
            var sum = early(i);
            if A && out[i] > 3u { sum += of_a(i); }
            if B || out[i] > 7u { sum += 3000u; }
            for (var k = 0u; k < 4u; k++) {
                if A && B { sum += of_b(k); continue; }
                if out[k] == 9u { break; }
                sum += 4000u;
            }
            // Known at first, but not the second time.
            var first = true;
            for (var k = 0u; k < 2u; k++) {
                if first { sum += 5000u; }
                first = false;
            }
            out[i] = sum;
        }";

    fn parsed() -> Module {
        let mut module = wgsl::parse_str(TEXT).unwrap();
        crate::gpu::bindings::number(&mut module);
        module
    }

    fn text_with(a: bool, b: bool) -> String {
        let module = parsed();
        let number = |on: bool| f64::from(u8::from(on));
        let switches = [("A", number(a)), ("B", number(b))];
        let module =
            specialized(&module, &checked(&module), ShaderStage::Compute, "cs_main", &switches).unwrap();
        let info = checked(&module);
        write_string(&module, &info, WriterFlags::empty()).unwrap()
    }

    #[test]
    fn what_is_switched_off_is_gone_and_nothing_else() {
        for (a, b) in [(false, false), (false, true), (true, false), (true, true)] {
            let text = text_with(a, b);
            let has = |what: &str| text.contains(what);
            assert_eq!(has("of_a") && has("only_a") && has("1000u"), a, "{text}");
            assert_eq!(has("of_b") || has("only_b") || has("2000u"), a && b, "{text}");
            assert_eq!(has("return 5u"), !a, "{text}");
            assert!(has("3000u") && has("5000u"), "{text}");
            assert_eq!(has("4000u"), !(a && b), "what follows `continue` is not reached: {text}");
            assert_eq!(has("7u"), !b, "{text}");
            assert!(has("if first") || text.matches("if ").count() >= 2, "{text}");
        }
    }

    #[test]
    fn a_switch_that_does_not_exist_is_an_error() {
        let module = parsed();
        let info = checked(&module);
        let error = specialized(&module, &info, ShaderStage::Compute, "cs_main", &[("C", 1.0)]).unwrap_err();
        assert!(error.contains('C'), "{error}");
    }

    #[test]
    fn every_shader_stays_valid_with_each_of_its_switches() {
        for file in Shaders::embedded() {
            let module = Shaders::default().validate(&file).unwrap();
            let info = checked(&module);
            let switches: Vec<_> =
                module.overrides.iter().filter_map(|(_, switch)| switch.name.as_deref()).collect();
            for entry in &module.entry_points {
                let one_on = (0..switches.len()).map(|on| move |i: usize| i == on);
                let none = |on: bool| move |_: usize| on;
                let mut choices: Vec<Box<dyn Fn(usize) -> bool>> =
                    vec![Box::new(none(false)), Box::new(none(true))];
                choices.extend(one_on.map(|choice| Box::new(choice) as Box<dyn Fn(usize) -> bool>));
                for choice in choices {
                    let values: Vec<_> = (0..)
                        .zip(&switches)
                        .map(|(i, name)| (*name, f64::from(u8::from(choice(i)))))
                        .collect();
                    let module = specialized(&module, &info, entry.stage, &entry.name, &values)
                        .unwrap_or_else(|error| panic!("{file}, {}, {values:?}: {error}", entry.name));
                    checked(&module);
                    assert!(module.overrides.is_empty() && module.entry_points.len() == 1);
                }
            }
        }
    }
}
