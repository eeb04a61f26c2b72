//! The list of parameters while it is being declared.

use std::ops::RangeInclusive;
use std::path::PathBuf;

use super::param::{Condition, Param, Scope};
use super::slot::{Choice, Slot, StyleField};
use super::{Color, Curve, Matrix};

/// The list while it is being declared.
#[derive(Default)]
pub struct Params<'a> {
    list: Vec<Param<'a>>,
    clamps: bool,
    prefix: String,
    conditions: Vec<Condition>,
    scope: Scope,
    detail: bool,
}

impl<'a> Params<'a> {
    /// A list that stays empty: every value that is declared to it is moved into its range.
    pub fn clamping() -> Self {
        Self { clamps: true, ..Self::default() }
    }

    /// Declares the parameters of one effect or group: their keys begin with `name.`.
    pub fn section(&mut self, name: &str, declare: impl FnOnce(&mut Self)) {
        let outer = self.prefix.len();
        self.prefix.push_str(name);
        self.prefix.push('.');
        declare(self);
        self.prefix.truncate(outer);
    }

    /// A section that the panel shows folded at first.
    pub fn detail(&mut self, name: &str, declare: impl FnOnce(&mut Self)) {
        let outer = std::mem::replace(&mut self.detail, true);
        self.section(name, declare);
        self.detail = outer;
    }

    /// Declares parameters that matter only while the choice, switch or whole number `key` (a whole key) is `value`, as it is
    /// written.
    pub fn when(
        &mut self,
        key: &'static str,
        value: impl Into<&'static str>,
        declare: impl FnOnce(&mut Self),
    ) {
        self.when_any(key, [value], declare);
    }

    /// The same for one of several values.
    pub fn when_any(
        &mut self,
        key: &'static str,
        values: impl IntoIterator<Item = impl Into<&'static str>>,
        declare: impl FnOnce(&mut Self),
    ) {
        let condition = Condition { key, values: values.into_iter().map(Into::into).collect() };
        let is_new = !self.conditions.contains(&condition);
        self.conditions.extend(is_new.then_some(condition));
        declare(self);
        if is_new {
            self.conditions.pop();
        }
    }

    /// Declares parameters that matter only there.
    pub fn only(&mut self, scope: Scope, declare: impl FnOnce(&mut Self)) {
        let outer = std::mem::replace(&mut self.scope, scope);
        declare(self);
        self.scope = outer;
    }

    fn push(
        &mut self,
        key: &str,
        label: &'static str,
        unit: &'static str,
        help: &'static str,
        mut slot: Slot<'a>,
    ) {
        if self.clamps {
            slot.clamp();
            return;
        }
        self.list.push(Param {
            key: format!("{}{key}", self.prefix),
            label,
            unit,
            help,
            conditions: self.conditions.clone(),
            scope: self.scope,
            detail: self.detail,
            head: false,
            span: None,
            former: None,
            former_value: None,
            slot,
        });
    }

    /// The switch of a whole section: the panel puts it and its label in the section's heading.
    pub fn head(
        &mut self,
        key: &str,
        label: &'static str,
        help: &'static str,
        value: impl Into<StyleField<'a, bool>>,
    ) {
        self.switch(key, label, help, value);
        if let Some(param) = self.list.last_mut() {
            param.head = true;
        }
    }

    /// Says how the parameter that was declared last was called in files of earlier versions, in the same section.
    pub fn formerly(&mut self, key: &str) {
        if let Some(param) = self.list.last_mut() {
            param.former = Some(format!("{}{key}", self.prefix));
        }
    }

    /// The same where it was in another section: the whole key.
    pub fn moved_from(&mut self, key: &str) {
        if let Some(param) = self.list.last_mut() {
            param.former = Some(key.to_owned());
        }
    }

    /// Says how a value of the choice that was declared last was called in files of earlier versions.
    pub fn former_value(&mut self, former: &'static str, value: impl Into<&'static str>) {
        if let Some(param) = self.list.last_mut() {
            param.former_value = Some((former, value.into()));
        }
    }

    /// A switch.
    pub fn switch(
        &mut self,
        key: &str,
        label: &'static str,
        help: &'static str,
        value: impl Into<StyleField<'a, bool>>,
    ) {
        self.push(key, label, "", help, Slot::Bool(value.into()));
    }

    /// A number and the range that is offered and accepted.
    pub fn number(
        &mut self,
        key: &str,
        label: &'static str,
        unit: &'static str,
        range: RangeInclusive<f32>,
        help: &'static str,
        value: impl Into<StyleField<'a, f32>>,
    ) {
        self.wide_number(key, label, unit, range.clone(), range, help, value);
    }

    /// A number of which more is accepted (`hard`) than its slider offers (`soft`).
    pub fn wide_number(
        &mut self,
        key: &str,
        label: &'static str,
        unit: &'static str,
        soft: RangeInclusive<f32>,
        hard: RangeInclusive<f32>,
        help: &'static str,
        value: impl Into<StyleField<'a, f32>>,
    ) {
        self.push(key, label, unit, help, Slot::Number { value: value.into(), soft, hard });
    }

    /// A share, 0 to 1.
    pub fn share(
        &mut self,
        key: &str,
        label: &'static str,
        help: &'static str,
        value: impl Into<StyleField<'a, f32>>,
    ) {
        self.number(key, label, "", 0.0..=1.0, help, value);
    }

    /// A whole number and the range that is offered and accepted.
    pub fn integer(
        &mut self,
        key: &str,
        label: &'static str,
        unit: &'static str,
        range: RangeInclusive<u32>,
        help: &'static str,
        value: &'a mut u32,
    ) {
        self.push(key, label, unit, help, Slot::Integer { value, range });
    }

    /// Two numbers that are the ends of one range, which the panel shows on one slider.
    pub fn span(&mut self, label: &'static str, declare: impl FnOnce(&mut Self)) {
        let first = self.list.len();
        declare(self);
        if let Some(param) = self.list.get_mut(first) {
            param.span = Some(label);
        }
    }

    /// A color.
    pub fn color(
        &mut self,
        key: &str,
        label: &'static str,
        help: &'static str,
        value: impl Into<StyleField<'a, Color>>,
    ) {
        self.push(key, label, "", help, Slot::Color(value.into()));
    }

    /// An image file (PNG or JPEG), or none. It is needed while the parameter matters; see [`super::Style::images`].
    pub fn file(
        &mut self,
        key: &str,
        label: &'static str,
        help: &'static str,
        value: &'a mut Option<PathBuf>,
    ) {
        self.push(key, label, "", help, Slot::File(value));
    }

    /// A 2×2 matrix, no number of which is greater than `most`.
    pub fn matrix(
        &mut self,
        key: &str,
        label: &'static str,
        unit: &'static str,
        most: f32,
        help: &'static str,
        value: &'a mut Matrix,
    ) {
        self.push(key, label, unit, help, Slot::Matrix { value, most });
    }

    /// A curve, whose x and y go from 0 to 1.
    pub fn curve(&mut self, key: &str, label: &'static str, help: &'static str, value: &'a mut Curve) {
        self.push(key, label, "", help, Slot::Curve(value));
    }

    /// One of the variants of an enumeration.
    pub fn choice(&mut self, key: &str, label: &'static str, help: &'static str, value: &'a mut dyn Choice) {
        self.push(key, label, "", help, Slot::Choice(value));
    }

    /// The finished list.
    pub fn finish(self) -> Vec<Param<'a>> {
        self.list
    }
}
