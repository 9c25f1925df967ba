//! A WebAssembly module in two: what is needed at once, and what is loaded when it is first called.
//!
//! A function that is reached from the entry points of the second part alone moves there. Where it is called through the
//! table all the same, a stub in the first part calls it through a slot of its own, which the second part fills when it is
//! loaded; so what moves is a matter of size, never of correctness. Memory, table and globals are shared. The first part
//! keeps no names and no exports but those asked for and those that the second part imports.

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
    /// The exports that stay.
    pub kept: &'a [&'a str],
    /// The exports whose functions are the entry points of the second part; they are exports of that.
    pub later: &'a [&'a str],
    /// Parts of names of functions that are called through the table by the second part alone.
    pub named: &'a [&'a str],
    /// Parts of names of functions that nothing calls: they stand in the table for somebody else's sake.
    pub dropped: &'a [&'a str],
    /// Constant texts that the second part alone reads.
    pub texts: &'a [Vec<u8>],
}

/// Both parts.
pub struct Parts {
    pub first: Vec<u8>,
    pub second: Vec<u8>,
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
pub fn split(wasm: &[u8], plan: &Plan) -> Result<Parts> {
    let whole = read(wasm)?;
    let calls: Vec<Vec<u32>> = whole.bodies.iter().map(calls).collect::<Result<_>>()?;
    let entry = |names: &[&str]| -> Result<Vec<u32>> {
        names
            .iter()
            .map(|name| {
                let found = whole.exports.iter().find(|e| e.0 == *name && e.1 == ExternalKind::Func);
                found.map(|e| e.2).with_context(|| format!("no function `{name}` is exported"))
            })
            .collect()
    };
    let has = |f: &u32, parts: &[&str]| {
        whole.names.get(f).is_some_and(|name| parts.iter().any(|part| name.contains(part)))
    };
    let is_named = |f: &u32| has(f, plan.named);
    let called: Vec<u32> = whole.elements.iter().copied().filter(|f| !has(f, plan.dropped)).collect();
    let functions: Vec<&str> = plan.kept.iter().copied().filter(|n| *n != "memory").collect();
    let reached = |from: Vec<u32>| {
        let mut seen = BTreeSet::new();
        let mut open = from;
        while let Some(f) = open.pop() {
            if seen.insert(f)
                && let Some(own) = (f as usize).checked_sub(whole.imported)
            {
                open.extend(&calls[own]);
            }
        }
        seen
    };
    let own = called.iter().copied().filter(|f| !is_named(f));
    let first = reached(entry(&functions)?.into_iter().chain(own).collect());
    let later = entry(plan.later)?;
    let all = reached(later.iter().copied().chain(called.iter().copied()).collect());
    let second: Vec<u32> = all.difference(&first).copied().collect();
    if second.iter().any(|&f| (f as usize) < whole.imported) {
        bail!("the second part would be an import");
    }

    // A slot of the table for each function of the second part that the first may call.
    let table = whole.table.context("no table")?;
    let start = table.initial;
    let called = whole.elements.iter().copied().filter(|f| second.binary_search(f).is_ok());
    let slots: Vec<u32> = called.collect::<BTreeSet<u32>>().into_iter().collect();
    let needed: BTreeSet<u32> = second
        .iter()
        .flat_map(|&f| calls[f as usize - whole.imported].iter().copied())
        .filter(|f| first.contains(f))
        .collect();
    let border = Border { slots, start, needed, data: divided(&whole, plan.texts) };
    Ok(Parts {
        first: first_part(&whole, plan, &first, &border)?,
        second: second_part(&whole, plan, &second, &later, &border)?,
    })
}

/// What both parts agree on.
struct Border<'a> {
    /// The functions of the second part that the first may call, in the order of their slots, and the first slot.
    slots: Vec<u32>,
    start: u64,
    /// The functions of the first part that the second calls.
    needed: BTreeSet<u32>,
    data: Divided<'a>,
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

fn first_part(whole: &Whole, plan: &Plan, first: &BTreeSet<u32>, border: &Border) -> Result<Vec<u8>> {
    let Border { slots, start, needed, data } = border;
    let mut module = Module::new();
    types(whole, &mut module)?;
    // What was imported is called by nothing that is left, but keeps its number.
    let mut functions = FunctionSection::new();
    for ty in &whole.functions {
        functions.function(*ty);
    }
    module.section(&functions);
    let table = whole.table.context("no table")?;
    let mut tables = TableSection::new();
    let mut grown = RoundtripReencoder.table_type(table)?;
    grown.minimum = start + slots.len() as u64;
    grown.maximum = grown.maximum.map(|m| m.max(grown.minimum));
    tables.table(grown);
    module.section(&tables);
    for id in [5, 6] {
        copy(whole, id, &mut module);
    }
    let mut exports = ExportSection::new();
    for (name, kind, index) in &whole.exports {
        if plan.kept.contains(name) {
            exports.export(name, RoundtripReencoder.export_kind(*kind)?, *index);
        }
    }
    exports.export("table", ExportKind::Table, 0);
    for k in 0..whole.globals.len() {
        exports.export(&crossing('g', k), ExportKind::Global, k as u32);
    }
    for (k, f) in needed.iter().enumerate() {
        exports.export(&crossing('f', k), ExportKind::Func, *f);
    }
    module.section(&exports);
    let mut elements = ElementSection::new();
    elements.active(None, &ConstExpr::i32_const(1), Elements::Functions((&whole.elements[..]).into()));
    module.section(&elements);
    let mut code = CodeSection::new();
    for f in 0..whole.functions.len() as u32 {
        let own = (f as usize).checked_sub(whole.imported);
        match (own, slots.binary_search(&f)) {
            (_, Ok(slot)) => {
                let ty = whole.functions[f as usize];
                let mut stub = Function::new([]);
                for k in 0..whole.types[ty as usize].params().len() {
                    stub.instruction(&Instruction::LocalGet(k as u32));
                }
                stub.instruction(&Instruction::I32Const((*start as usize + slot) as i32));
                stub.instruction(&Instruction::CallIndirect { type_index: ty, table_index: 0 });
                stub.instruction(&Instruction::End);
                code.function(&stub);
            }
            (Some(k), _) if first.contains(&f) => {
                RoundtripReencoder.parse_function_body(&mut code, whole.bodies[k].clone())?;
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
    module.section(&constants(&data.first));
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

fn second_part(
    whole: &Whole,
    plan: &Plan,
    second: &[u32],
    later: &[u32],
    border: &Border,
) -> Result<Vec<u8>> {
    let Border { slots, start, needed, data } = border;
    let mut module = Module::new();
    types(whole, &mut module)?;
    let mut imports = ImportSection::new();
    let mut numbers = BTreeMap::new();
    for (k, f) in needed.iter().enumerate() {
        imports.import("first", &crossing('f', k), EntityType::Function(whole.functions[*f as usize]));
        numbers.insert(*f, k as u32);
    }
    for (k, f) in second.iter().enumerate() {
        numbers.insert(*f, (needed.len() + k) as u32);
    }
    let memory = memory_type(whole)?;
    imports.import("first", "memory", memory);
    let mut table = RoundtripReencoder.table_type(whole.table.context("no table")?)?;
    table.minimum = start + slots.len() as u64;
    table.maximum = table.maximum.map(|m| m.max(table.minimum));
    imports.import("first", "table", table);
    for (k, global) in whole.globals.iter().enumerate() {
        imports.import("first", &crossing('g', k), RoundtripReencoder.global_type(*global)?);
    }
    module.section(&imports);
    let mut functions = FunctionSection::new();
    for f in second {
        functions.function(whole.functions[*f as usize]);
    }
    module.section(&functions);
    let mut exports = ExportSection::new();
    for (name, f) in plan.later.iter().zip(later) {
        exports.export(name, ExportKind::Func, numbers[f]);
    }
    module.section(&exports);
    let filled: Vec<u32> = slots.iter().map(|f| numbers[f]).collect();
    let mut elements = ElementSection::new();
    elements.active(None, &ConstExpr::i32_const(*start as i32), Elements::Functions((&filled[..]).into()));
    module.section(&elements);
    let mut code = CodeSection::new();
    for f in second {
        Renumbered(&numbers)
            .parse_function_body(&mut code, whole.bodies[*f as usize - whole.imported].clone())?;
    }
    module.section(&code);
    module.section(&constants(&data.second));
    Ok(module.finish())
}

/// Constant data, where it is in memory.
struct Divided<'a> {
    first: Vec<(u32, &'a [u8])>,
    second: Vec<(u32, &'a [u8])>,
}

/// The texts of the second part taken out of the data of the first.
fn divided<'a>(whole: &Whole<'a>, texts: &[Vec<u8>]) -> Divided<'a> {
    let mut divided = Divided { first: vec![], second: vec![] };
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
                divided.second.push((start + cut.start as u32, &bytes[cut.clone()]));
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
