//! A WebAssembly module in parts: what is needed at once, and what is loaded when it is first called.
//!
//! A function stands in the first part from whose entry points it is reached. Where a function of a later part is called
//! through the table, a stub in the first part calls it through a slot of its own, which the later part fills when it is
//! loaded; so what stands where is a matter of size, never of correctness. Memory, table and globals are shared. No part
//! keeps names, or exports but those asked for and those that later parts import.

use anyhow::{Context, Result, bail};
use std::collections::{BTreeMap, BTreeSet};
use wasm_encoder::reencode::{Error, Reencode, RoundtripReencoder};
use wasm_encoder::{
    CodeSection, ConstExpr, DataSection, ElementSection, Elements, EntityType, ExportKind, ExportSection,
    Function, FunctionSection, ImportSection, Instruction, Module, RawSection, TableSection, TypeSection,
};
use wasmparser::{
    BinaryReader, CompositeInnerType, DataKind, ElementItems, ExternalKind, FuncType, FunctionBody,
    GlobalType, KnownCustom, Name, Operator, Parser, Payload, TableType, TypeRef,
};

/// What is to be divided, and how.
pub struct Plan<'a> {
    /// The parts, the first at once; a later one is loaded behind all before it.
    pub parts: &'a [Part<'a>],
    /// Parts of names of functions that nothing calls: they stand in the table for somebody else's sake.
    pub dropped: &'a [&'a str],
    /// Constant texts, and the part that alone reads them.
    pub texts: &'a [Vec<u8>],
    pub reader: usize,
}

/// A part of the module.
pub struct Part<'a> {
    /// Its exports.
    pub exports: &'a [&'a str],
    /// Parts of names of functions that are called through the table by this part, or later ones; of several that fit the
    /// last counts.
    pub named: &'a [&'a str],
}

/// A module as far as it has to be known.
#[derive(Default)]
struct Whole<'a> {
    types: Vec<FuncType>,
    /// The type of every function, imported ones first.
    functions: Vec<u32>,
    imported: usize,
    bodies: Vec<FunctionBody<'a>>,
    names: BTreeMap<u32, String>,
    table: Option<TableType>,
    globals: Vec<GlobalType>,
    exports: Vec<(&'a str, ExternalKind, u32)>,
    /// The functions in the table.
    elements: Vec<u32>,
    /// Constant data and where it stands in memory.
    data: Vec<(u32, &'a [u8])>,
    /// Sections that are copied as they are, by their numbers.
    raw: BTreeMap<u8, &'a [u8]>,
}

/// Divides a module.
///
/// # Errors
/// If it is not a module as the linker of Rust makes it, or lacks an export of the plan.
pub fn split(wasm: &[u8], plan: &Plan) -> Result<Vec<Vec<u8>>> {
    let whole = read(wasm)?;
    let calls: Vec<Vec<u32>> = whole.bodies.iter().map(calls).collect::<Result<_>>()?;
    let has = |f: &u32, parts: &[&str]| {
        whole.names.get(f).is_some_and(|name| parts.iter().any(|part| name.contains(part)))
    };
    let level = |f: &u32| plan.parts.iter().rposition(|part| has(f, part.named)).unwrap_or(0);
    let called: Vec<u32> = whole.elements.iter().copied().filter(|f| !has(f, plan.dropped)).collect();

    // The part of each function that is reached.
    let mut part: BTreeMap<u32, usize> = BTreeMap::new();
    for (k, wanted) in plan.parts.iter().enumerate() {
        let mut open: Vec<u32> = called.iter().copied().filter(|f| level(f) == k).collect();
        for name in wanted.exports {
            open.extend(whole.function(name)?);
        }
        while let Some(f) = open.pop() {
            if part.contains_key(&f) {
                continue;
            }
            part.insert(f, k);
            match (f as usize).checked_sub(whole.imported) {
                Some(own) => open.extend(&calls[own]),
                None if k > 0 => bail!("a later part would be an import"),
                None => {}
            }
        }
    }
    let slots = |k: usize| -> Vec<u32> {
        let own = called.iter().copied().filter(|f| part.get(f) == Some(&k));
        if k == 0 { vec![] } else { own.collect::<BTreeSet<u32>>().into_iter().collect() }
    };
    let slots: Vec<Vec<u32>> = (0..plan.parts.len()).map(slots).collect();
    // What crosses a border, by the number that it has on it.
    let mut needed: BTreeMap<u32, usize> = BTreeMap::new();
    for (f, own) in &part {
        let Some(body) = (*f as usize).checked_sub(whole.imported) else { continue };
        for g in calls[body].iter().filter(|g| part.get(g).is_some_and(|other| other < own)) {
            let next = needed.len();
            needed.entry(*g).or_insert(next);
        }
    }
    let border = Border { part, slots, needed, data: divided(&whole, plan.texts), reader: plan.reader };
    let mut made = vec![];
    for (k, wanted) in plan.parts.iter().enumerate() {
        let part = if k == 0 { first(&whole, wanted, &border)? } else { later(&whole, wanted, &border, k)? };
        wasmparser::validate(&part).with_context(|| format!("part {k} is no module"))?;
        made.push(part);
    }
    Ok(made)
}

/// What all parts agree on.
struct Border<'a> {
    /// The part of each function that is needed.
    part: BTreeMap<u32, usize>,
    /// For each part its functions that an earlier one may call through the table, in the order of their slots.
    slots: Vec<Vec<u32>>,
    /// The functions that a later part calls, with numbers for their names.
    needed: BTreeMap<u32, usize>,
    data: Divided<'a>,
    reader: usize,
}

impl Border<'_> {
    /// The first slot of a part, behind the table as it was.
    fn start(&self, table: &TableType, part: usize) -> u64 {
        table.initial + self.slots[..part].iter().map(|s| s.len() as u64).sum::<u64>()
    }

    /// The slot of a function.
    fn slot(&self, table: &TableType, f: u32) -> Option<u64> {
        let part = *self.part.get(&f)?;
        let at = self.slots[part].binary_search(&f).ok()?;
        Some(self.start(table, part) + at as u64)
    }

    /// The functions that a part has of its own, in their order.
    fn own(&self, part: usize) -> Vec<u32> {
        self.part.iter().filter(|(_, k)| **k == part).map(|(f, _)| *f).collect()
    }

    /// The table with all slots.
    fn table(&self, table: TableType) -> Result<wasm_encoder::TableType> {
        let mut grown = RoundtripReencoder.table_type(table)?;
        grown.minimum = self.start(&table, self.slots.len());
        grown.maximum = grown.maximum.map(|m| m.max(grown.minimum));
        Ok(grown)
    }

    /// Exports what later parts need of a part; `number` is a function's number in it.
    fn export(&self, part: usize, exports: &mut ExportSection, number: impl Fn(u32) -> u32) {
        for (f, k) in self.needed.iter().filter(|(f, _)| self.part.get(f) == Some(&part)) {
            exports.export(&crossing('f', *k), ExportKind::Func, number(*f));
        }
    }
}

impl Whole<'_> {
    /// The function that is exported under a name; none for an export of another kind.
    fn function(&self, name: &str) -> Result<Option<u32>> {
        let export = self.exports.iter().find(|e| e.0 == name);
        let export = export.with_context(|| format!("nothing is exported as `{name}`"))?;
        Ok((export.1 == ExternalKind::Func).then_some(export.2))
    }
}

fn read(wasm: &[u8]) -> Result<Whole<'_>> {
    let mut whole = Whole::default();
    for payload in Parser::new(0).parse_all(wasm) {
        let payload = payload?;
        let copied = match &payload {
            Payload::MemorySection(r) => Some((5, r.range())),
            Payload::GlobalSection(r) => Some((6, r.range())),
            _ => None,
        };
        if let Some((id, range)) = copied {
            whole.raw.insert(id, &wasm[range.start as usize..range.end as usize]);
        }
        match payload {
            Payload::TypeSection(reader) => {
                for group in reader {
                    for ty in group?.into_types() {
                        match ty.composite_type.inner {
                            CompositeInnerType::Func(f) => whole.types.push(f),
                            _ => bail!("a type that is not a function's"),
                        }
                    }
                }
            }
            Payload::ImportSection(reader) => {
                for import in reader.into_imports() {
                    match import?.ty {
                        TypeRef::Func(ty) => whole.functions.push(ty),
                        other => bail!("an import that is not a function: {other:?}"),
                    }
                }
                whole.imported = whole.functions.len();
            }
            Payload::FunctionSection(reader) => {
                for ty in reader {
                    whole.functions.push(ty?);
                }
            }
            Payload::TableSection(reader) => {
                for table in reader {
                    if whole.table.replace(table?.ty).is_some_and(|t| t.element_type.is_func_ref()) {
                        bail!("two tables of functions");
                    }
                }
            }
            Payload::GlobalSection(reader) => {
                for global in reader {
                    whole.globals.push(global?.ty);
                }
            }
            Payload::ExportSection(reader) => {
                for export in reader {
                    let export = export?;
                    whole.exports.push((export.name, export.kind, export.index));
                }
            }
            Payload::ElementSection(reader) => {
                for element in reader {
                    match element?.items {
                        ElementItems::Functions(all) => {
                            for f in all {
                                whole.elements.push(f?);
                            }
                        }
                        ElementItems::Expressions(..) => bail!("a table of expressions"),
                    }
                }
            }
            Payload::DataSection(reader) => {
                for segment in reader {
                    let segment = segment?;
                    let DataKind::Active { memory_index: 0, offset_expr } = segment.kind else {
                        bail!("data without a place")
                    };
                    let Operator::I32Const { value } = offset_expr.get_operators_reader().read()? else {
                        bail!("data at a place that is not constant")
                    };
                    whole.data.push((value as u32, segment.data));
                }
            }
            Payload::CodeSectionEntry(body) => whole.bodies.push(body),
            Payload::CustomSection(custom) => {
                if let KnownCustom::Name(names) = custom.as_known() {
                    for part in names {
                        if let Name::Function(map) = part? {
                            for naming in map {
                                let naming = naming?;
                                whole.names.insert(
                                    naming.index,
                                    format!("{:#}", rustc_demangle::demangle(naming.name)),
                                );
                            }
                        }
                    }
                }
            }
            _ => {}
        }
    }
    Ok(whole)
}

/// The functions that a body calls or refers to by number.
fn calls(body: &FunctionBody) -> Result<Vec<u32>> {
    let mut found = vec![];
    for operator in body.get_operators_reader()? {
        match operator? {
            Operator::Call { function_index } | Operator::RefFunc { function_index } => {
                found.push(function_index)
            }
            _ => {}
        }
    }
    Ok(found)
}

/// Short names for what crosses the border.
fn crossing(kind: char, k: usize) -> String {
    format!("{kind}{k}")
}

fn first(whole: &Whole, wanted: &Part, border: &Border) -> Result<Vec<u8>> {
    let table = whole.table.context("no table")?;
    let mut module = Module::new();
    types(whole, &mut module)?;
    // What was imported is called by nothing that is left, but keeps its number.
    let mut functions = FunctionSection::new();
    for ty in &whole.functions {
        functions.function(*ty);
    }
    module.section(&functions);
    let mut tables = TableSection::new();
    tables.table(border.table(table)?);
    module.section(&tables);
    for id in [5, 6] {
        copy(whole, id, &mut module);
    }
    let mut exports = ExportSection::new();
    for (name, kind, index) in whole.exports.iter().filter(|e| wanted.exports.contains(&e.0)) {
        exports.export(name, RoundtripReencoder.export_kind(*kind)?, *index);
    }
    exports.export("table", ExportKind::Table, 0);
    for k in 0..whole.globals.len() {
        exports.export(&crossing('g', k), ExportKind::Global, k as u32);
    }
    border.export(0, &mut exports, |f| f);
    module.section(&exports);
    let mut elements = ElementSection::new();
    elements.active(None, &ConstExpr::i32_const(1), Elements::Functions((&whole.elements[..]).into()));
    module.section(&elements);
    let mut code = CodeSection::new();
    for f in 0..whole.functions.len() as u32 {
        let body = (f as usize).checked_sub(whole.imported).map(|k| &whole.bodies[k]);
        match (body, border.slot(&table, f)) {
            (_, Some(slot)) => {
                let ty = whole.functions[f as usize];
                let mut stub = Function::new([]);
                for k in 0..whole.types[ty as usize].params().len() {
                    stub.instruction(&Instruction::LocalGet(k as u32));
                }
                stub.instruction(&Instruction::I32Const(slot as i32));
                stub.instruction(&Instruction::CallIndirect { type_index: ty, table_index: 0 });
                stub.instruction(&Instruction::End);
                code.function(&stub);
            }
            (Some(body), _) if border.part.get(&f) == Some(&0) => {
                RoundtripReencoder.parse_function_body(&mut code, body.clone())?;
            }
            _ => {
                let mut nothing = Function::new([]);
                nothing.instruction(&Instruction::Unreachable);
                nothing.instruction(&Instruction::End);
                code.function(&nothing);
            }
        }
    }
    module.section(&code);
    module.section(&constants(&border.data.first));
    Ok(module.finish())
}

/// Functions by their new numbers.
struct Renumbered<'a>(&'a BTreeMap<u32, u32>);

impl Reencode for Renumbered<'_> {
    type Error = std::convert::Infallible;

    fn function_index(&mut self, f: u32) -> Result<u32, Error<Self::Error>> {
        // Every function that a body calls is in one of the parts.
        Ok(self.0.get(&f).copied().unwrap_or(u32::MAX))
    }
}

fn later(whole: &Whole, wanted: &Part, border: &Border, part: usize) -> Result<Vec<u8>> {
    let table = whole.table.context("no table")?;
    let own = border.own(part);
    let mut module = Module::new();
    types(whole, &mut module)?;
    let mut imports = ImportSection::new();
    let mut numbers = BTreeMap::new();
    let is_called: BTreeSet<u32> = own
        .iter()
        .map(|&f| calls(&whole.bodies[f as usize - whole.imported]))
        .collect::<Result<Vec<_>>>()?
        .into_iter()
        .flatten()
        .collect();
    for (f, k) in border.needed.iter().filter(|(f, _)| is_called.contains(f)) {
        let from = border.part.get(f).copied().unwrap_or(part);
        if from < part {
            numbers.insert(*f, numbers.len() as u32);
            let ty = EntityType::Function(whole.functions[*f as usize]);
            imports.import(&from.to_string(), &crossing('f', *k), ty);
        }
    }
    let imported = numbers.len();
    for (k, f) in own.iter().enumerate() {
        numbers.insert(*f, (imported + k) as u32);
    }
    imports.import("0", "memory", memory_type(whole)?);
    imports.import("0", "table", border.table(table)?);
    for (k, global) in whole.globals.iter().enumerate() {
        imports.import("0", &crossing('g', k), RoundtripReencoder.global_type(*global)?);
    }
    module.section(&imports);
    let mut functions = FunctionSection::new();
    for f in &own {
        functions.function(whole.functions[*f as usize]);
    }
    module.section(&functions);
    let mut exports = ExportSection::new();
    for name in wanted.exports {
        if let Some(f) = whole.function(name)? {
            exports.export(name, ExportKind::Func, numbers[&f]);
        }
    }
    border.export(part, &mut exports, |f| numbers[&f]);
    module.section(&exports);
    let filled: Vec<u32> = border.slots[part].iter().map(|f| numbers[f]).collect();
    let mut elements = ElementSection::new();
    let start = border.start(&table, part) as i32;
    elements.active(None, &ConstExpr::i32_const(start), Elements::Functions((&filled[..]).into()));
    module.section(&elements);
    let mut code = CodeSection::new();
    for f in own {
        Renumbered(&numbers)
            .parse_function_body(&mut code, whole.bodies[f as usize - whole.imported].clone())?;
    }
    module.section(&code);
    (part == border.reader).then(|| module.section(&constants(&border.data.texts)));
    Ok(module.finish())
}

/// Constant data, where it is in memory.
struct Divided<'a> {
    first: Vec<(u32, &'a [u8])>,
    texts: Vec<(u32, &'a [u8])>,
}

/// The texts of one part taken out of the data of the first.
fn divided<'a>(whole: &Whole<'a>, texts: &[Vec<u8>]) -> Divided<'a> {
    let mut divided = Divided { first: vec![], texts: vec![] };
    for &(start, bytes) in &whole.data {
        let found =
            texts.iter().filter_map(|text| memchr::memmem::find(bytes, text).map(|at| at..at + text.len()));
        let mut cuts: Vec<std::ops::Range<usize>> = found.collect();
        cuts.sort_by_key(|cut| cut.start);
        let mut done = 0;
        for cut in cuts {
            // A text may lie in another.
            if cut.start >= done {
                divided.first.push((start + done as u32, &bytes[done..cut.start]));
                divided.texts.push((start + cut.start as u32, &bytes[cut.clone()]));
                done = cut.end;
            }
        }
        divided.first.push((start + done as u32, &bytes[done..]));
    }
    divided
}

fn constants(segments: &[(u32, &[u8])]) -> DataSection {
    let mut section = DataSection::new();
    for &(at, bytes) in segments {
        section.active(0, &ConstExpr::i32_const(at as i32), bytes.iter().copied());
    }
    section
}

fn types(whole: &Whole, module: &mut Module) -> Result<()> {
    let mut types = TypeSection::new();
    for ty in &whole.types {
        types.ty().func_type(&RoundtripReencoder.func_type(ty.clone())?);
    }
    module.section(&types);
    Ok(())
}

fn copy(whole: &Whole, id: u8, module: &mut Module) {
    if let Some(data) = whole.raw.get(&id) {
        module.section(&RawSection { id, data });
    }
}

fn memory_type(whole: &Whole) -> Result<wasm_encoder::MemoryType> {
    let section = whole.raw.get(&5).context("no memory")?;
    let mut reader = wasmparser::MemorySectionReader::new(BinaryReader::new(section, 0))?.into_iter();
    let memory = reader.next().context("no memory")??;
    Ok(RoundtripReencoder.memory_type(memory)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use wasm_encoder::{DataSection, MemorySection, MemoryType, RefType, ValType};

    /// A module whose function 0 is `now`, 1 is `later`, 2 is called by both, 3 by `later` alone, 4 through the table alone.
    fn module() -> Vec<u8> {
        let mut module = Module::new();
        let mut types = TypeSection::new();
        types.ty().function([ValType::I32], [ValType::I32]);
        module.section(&types);
        let mut functions = FunctionSection::new();
        for _ in 0..5 {
            functions.function(0);
        }
        module.section(&functions);
        let mut tables = TableSection::new();
        tables.table(wasm_encoder::TableType {
            element_type: RefType::FUNCREF,
            table64: false,
            minimum: 2,
            maximum: Some(2),
            shared: false,
        });
        module.section(&tables);
        let mut memories = MemorySection::new();
        memories.memory(MemoryType {
            minimum: 1,
            maximum: None,
            memory64: false,
            shared: false,
            page_size_log2: None,
        });
        module.section(&memories);
        let mut exports = ExportSection::new();
        exports.export("memory", ExportKind::Memory, 0);
        exports.export("now", ExportKind::Func, 0);
        exports.export("later", ExportKind::Func, 1);
        module.section(&exports);
        let mut elements = ElementSection::new();
        elements.active(None, &ConstExpr::i32_const(1), Elements::Functions((&[4_u32][..]).into()));
        module.section(&elements);
        let mut code = CodeSection::new();
        for calls in [&[2][..], &[2, 3], &[], &[], &[]] {
            let mut body = Function::new([]);
            body.instruction(&Instruction::LocalGet(0));
            for f in calls {
                body.instruction(&Instruction::Call(*f));
            }
            body.instruction(&Instruction::End);
            code.function(&body);
        }
        module.section(&code);
        let mut data = DataSection::new();
        data.active(0, &ConstExpr::i32_const(16), b"kept, a text of a later part, kept".iter().copied());
        module.section(&data);
        let mut names = wasm_encoder::NameSection::new();
        let mut map = wasm_encoder::NameMap::new();
        map.append(4, "deriving");
        names.functions(&map);
        module.section(&names);
        module.finish()
    }

    fn parts(named: &[&str]) -> Vec<Vec<u8>> {
        let parts = [Part { exports: &["memory", "now"], named: &[] }, Part { exports: &["later"], named }];
        let texts = [b"a text of a later part".to_vec()];
        split(&module(), &Plan { parts: &parts, dropped: &[], texts: &texts, reader: 1 }).unwrap()
    }

    #[test]
    fn a_function_stands_where_it_is_reached_first() {
        let [first, second] = &parts(&["deriving"])[..] else { panic!("two parts") };
        let (first, second) = (read(first).unwrap(), names_of(second));
        // All functions keep their numbers in the first part; the slot of number 4 is behind the table as it was.
        assert_eq!(first.functions.len(), 5);
        assert_eq!(first.table.unwrap().initial, 3);
        assert_eq!(first.exports.iter().map(|e| e.0).collect::<Vec<_>>(), ["memory", "now", "table", "f0"]);
        assert_eq!(
            second,
            (vec!["0.f0".into(), "0.memory".into(), "0.table".into()], vec!["later".into()], 3)
        );
        assert_eq!(first.data, [(16, &b"kept, "[..]), (44, &b", kept"[..])]);
    }

    #[test]
    fn what_is_not_named_stays() {
        let [first, second] = &parts(&[])[..] else { panic!("two parts") };
        assert_eq!(read(first).unwrap().table.unwrap().initial, 2);
        assert_eq!(names_of(second).2, 2);
    }

    #[test]
    fn an_export_that_is_missing_is_named() {
        let parts = [Part { exports: &["nothing"], named: &[] }];
        let why = split(&module(), &Plan { parts: &parts, dropped: &[], texts: &[], reader: 0 }).unwrap_err();
        assert_eq!(why.to_string(), "nothing is exported as `nothing`");
    }

    /// Imports, exports, and how many functions a part has of its own.
    fn names_of(wasm: &[u8]) -> (Vec<String>, Vec<String>, usize) {
        let (mut imports, mut exports, mut own) = (vec![], vec![], 0);
        for payload in Parser::new(0).parse_all(wasm) {
            match payload.unwrap() {
                Payload::ImportSection(reader) => {
                    for import in reader.into_imports() {
                        let import = import.unwrap();
                        imports.push(format!("{}.{}", import.module, import.name));
                    }
                }
                Payload::ExportSection(reader) => {
                    exports.extend(reader.into_iter().map(|e| e.unwrap().name.to_string()));
                }
                Payload::CodeSectionStart { count, .. } => own = count as usize,
                _ => {}
            }
        }
        (imports, exports, own)
    }
}
