//! Tests of the code that the attributes generate for an object type.

use burgeon_kit::{
    Call, Construct, Draw, Drawing, Object, Result, Table, TableKey, Value, fields, methods, object,
};

/// What `tower { ... }` takes.
#[fields("tower")]
pub struct TowerOptions {
    /// How high it is at first (m).
    #[default(12.0)]
    pub height: f64,
    /// How many floors it has,
    /// the one on the ground among them.
    #[default(2 + 1)]
    pub floors: u32,
    /// What people call it.
    pub names: Vec<String>,
    /// What it is for; nobody knows if it is left out.
    pub r#type: Option<String>,
}

/// A tower
/// of bricks.
///
/// Nobody needs to know its architect.
#[object("tower", options = TowerOptions, end = finish)]
pub struct Tower {
    options: TowerOptions,
}

impl Tower {
    fn new(options: TowerOptions) -> Result<Self> {
        Ok(Self { options })
    }

    fn finish(&mut self) -> Result<()> {
        self.options.floors += 1;
        Ok(())
    }
}

/// A heap.
#[object(
    "heap",
    draws,
    begins_empty,
    deprecates("width", "1.3", "size"),
    deprecates("add", "1.3", "grow"),
    renames("girth", "1.3", "width"),
    renames("stack", "1.3", "add")
)]
pub struct Heap {
    /// How wide it is (m).
    #[default(2.0)]
    pub width: f64,
    #[default(1)]
    layers: u32,
    drawing: Drawing,
}

#[methods("heap")]
impl Heap {
    /// Adds a layer.
    pub fn add(&mut self) {
        self.layers += 1;
    }
}

#[methods("tower")]
impl Tower {
    /// Raises it by `height` (m), at most to `most`.
    /// A second line.
    pub fn raise(&mut self, height: f64, most: Option<f64>) -> Result<f64> {
        self.options.height = (self.options.height + height).min(most.unwrap_or(f64::INFINITY));
        Ok(self.options.height)
    }

    /// Gives it a name; the names of arguments here are those of the generated code.
    pub fn name(&mut self, given: String, arguments: f64, object: bool) {
        self.options.names.push(format!("{given} {arguments} {object}"));
    }

    /// Puts it back.
    pub fn reset(&mut self) {
        self.options = TowerOptions::default();
    }

    /// How high it is (m).
    pub fn height(&self) -> f64 {
        self.options.height
    }
}

/// An object of another type.
#[object("tower", given)]
struct Other;

#[methods("tower")]
impl Other {}

fn table(entries: &[(&str, Value)]) -> Table {
    let entries = entries.iter().map(|(name, value)| (TableKey::Name((*name).into()), value.clone()));
    Table { class: None, entries: entries.collect() }
}

fn text(text: &str) -> Value {
    Value::Text(text.into())
}

/// Calls a method with values.
fn call(tower: &mut dyn Object, name: &str, values: &[Value]) -> std::result::Result<Value, String> {
    let answer = match &Tower::kind().method(name).expect("the method is there").call {
        Call::Read(read) => read(tower, values),
        Call::Write { values: write, .. } => write(tower, values),
        Call::Script { .. } => panic!("it is of Rust"),
    };
    answer.map_err(|error| error.message().to_owned())
}

#[test]
fn fields_are_listed_as_they_were_written() {
    let fields = TowerOptions::fields();
    let listed: Vec<[&str; 5]> = fields
        .iter()
        .map(|field| {
            [
                &field.name,
                field.luau.as_str(),
                field.unit.as_deref().unwrap_or("-"),
                field.default.as_str(),
                &field.doc,
            ]
        })
        .collect();
    assert_eq!(
        listed,
        [
            ["height", "number", "m", "12", "How high it is at first (m)."],
            ["floors", "number", "-", "3", "How many floors it has,\nthe one on the ground among them."],
            ["names", "{ string }", "-", "{}", "What people call it."],
            ["type", "string?", "-", "nil", "What it is for; nobody knows if it is left out."],
        ]
    );
}

#[test]
fn a_table_is_read_or_refused() {
    let options = TowerOptions::from_table(&table(&[("height", Value::Number(5.0)), ("type", text("bell"))]));
    let options = options.expect("both fields are there");
    assert_eq!((options.height.to_bits(), options.floors), (5f64.to_bits(), 3));
    assert_eq!(options.r#type.as_deref(), Some("bell"));
    for (given, message) in [
        (("hight", Value::Number(5.0)), "unknown field `hight` in tower"),
        (("floors", Value::Number(0.5)), "tower: floors must be an integer of at least 0, not 0.5"),
        (("height", text("high")), "tower: height must be a number, not \"high\""),
    ] {
        let error = TowerOptions::from_table(&table(&[given])).expect_err(message);
        assert_eq!(error.message(), message);
    }
}

#[test]
fn methods_are_listed_as_they_were_written() {
    let listed: Vec<String> = Tower::methods()
        .iter()
        .map(|method| {
            let arguments = method.arguments.iter().map(|argument| {
                let unit = argument.unit.as_ref().map_or(String::new(), |unit| format!(" ({unit})"));
                format!("{}: {}{unit}", argument.name, argument.luau)
            });
            let way = match &method.call {
                Call::Read(_) => "reads",
                Call::Write { numbers: Some(_), .. } => "changes by numbers",
                Call::Write { numbers: None, .. } => "changes",
                Call::Script { .. } => "is of a script",
            };
            let arguments = arguments.collect::<Vec<_>>().join(", ");
            format!("{}({arguments}) -> [{}] {way}: {}", method.name, method.returns, method.doc)
        })
        .collect();
    assert_eq!(
        listed,
        [
            "raise(height: number (m), most: number?) -> [number] changes by numbers: Raises it by `height` (m), at \
             most to `most`.\nA second line.",
            "name(given: string, arguments: number, object: boolean) -> [] changes: Gives it a name; the names of \
             arguments here are those of the generated code.",
            "reset() -> [] changes by numbers: Puts it back.",
            "height() -> [number] reads: How high it is (m).",
        ]
    );
}

#[test]
fn a_method_is_called_with_values() {
    let mut tower = Tower { options: TowerOptions::default() };
    assert_eq!(call(&mut tower, "raise", &[Value::Number(3.0)]), Ok(Value::Number(15.0)));
    assert_eq!(
        call(&mut tower, "raise", &[Value::Number(3.0), Value::Number(16.0)]),
        Ok(Value::Number(16.0))
    );
    assert_eq!(call(&mut tower, "height", &[]), Ok(Value::Number(16.0)));
    let named = call(&mut tower, "name", &[text("a"), Value::Number(1.0), Value::Boolean(true)]);
    assert_eq!((named, tower.options.names.join(",").as_str()), (Ok(Value::Nil), "a 1 true"));
    assert_eq!(call(&mut tower, "reset", &[]), Ok(Value::Nil));
    assert_eq!(tower.height().to_bits(), 12f64.to_bits());
}

#[test]
fn a_call_that_does_not_fit_is_refused() {
    let mut tower = Tower { options: TowerOptions::default() };
    for (name, values, message) in [
        ("raise", vec![text("up")], "tower:raise: height must be a number, not \"up\""),
        ("raise", vec![], "tower:raise: height must be a number, not nothing"),
        ("reset", vec![Value::Nil], "tower:reset takes 0 arguments, not 1"),
        ("height", vec![Value::Nil, Value::Nil], "tower:height takes 0 arguments, not 2"),
    ] {
        assert_eq!(call(&mut tower, name, &values), Err(message.to_owned()));
    }
    for name in ["reset", "height"] {
        let message = "the method belongs to another object type";
        assert_eq!(call(&mut Other, name, &[]), Err(message.to_owned()));
    }
}

#[test]
fn a_method_of_numbers_is_called_with_numbers() {
    let mut tower = Tower { options: TowerOptions::default() };
    let method = Tower::kind().method("raise").expect("it is there");
    let Call::Write { numbers: Some(raise), .. } = &method.call else { panic!("it takes numbers") };
    raise(&mut tower, &[3.0, 14.0]).expect("two numbers");
    assert_eq!(tower.height().to_bits(), 14f64.to_bits());
    let error = raise(&mut tower, &[f64::NAN, 14.0]).expect_err("no number");
    assert_eq!(error.message(), "tower:raise: height must be a finite number, not NaN");
}

#[test]
fn a_type_is_what_its_struct_says() {
    let kind = Tower::kind();
    assert_eq!((&*kind.name, &*kind.doc), ("tower", "A tower of bricks."));
    assert_eq!((kind.fields.len(), kind.methods.len(), kind.begins_empty), (4, 4, false));
    let mut tower = kind.make(&table(&[("floors", Value::Number(7.0))])).expect("floors is a field");
    tower.end().expect("it can");
    assert_eq!(call(&mut *tower, "height", &[]), Ok(Value::Number(12.0)));
    let mut own = Tower { options: TowerOptions::default() };
    own.end().expect("it can");
    assert_eq!(own.options.floors, 4, "the method that the attribute names was called");
    let instead = ["width", "add"].map(|name| Heap::kind().deprecation(name).map(|it| it.instead.clone()));
    assert_eq!(instead, [Some("size".into()), Some("grow".into())]);
    let heap = Heap::kind().make(&table(&[("girth", Value::Number(3.0))])).expect("girth is a former name");
    let heap = (&*heap as &dyn std::any::Any).downcast_ref::<Heap>().expect("it is a heap");
    assert_eq!(heap.width.to_bits(), 3f64.to_bits());
    let stack = Heap::kind().method("stack").expect("stack is a former name");
    assert!(stack.call.changes());
    assert_eq!(Heap::kind().deprecation("stack").map(|it| &*it.instead), Some("heap:add"));
    assert!(matches!(Other::kind().construct, Construct::Given) && Other::kind().fields.is_empty());
    assert!(
        !kind.has_capability::<dyn Draw>()
            && Heap::kind().has_capability::<dyn Draw>()
            && Heap::kind().begins_empty
    );
}

#[test]
fn what_is_empty_again_keeps_what_scripts_gave() {
    assert_eq!(Heap::kind().fields.len(), 1, "scripts give public fields alone");
    let mut heap = Heap::from_table(&table(&[("width", Value::Number(5.0))])).expect("width is a field");
    assert_eq!(heap.layers, 1);
    heap.add();
    heap.begin();
    assert_eq!((heap.width.to_bits(), heap.layers), (5f64.to_bits(), 1));
    assert!(Heap::from_table(&table(&[("layers", Value::Number(5.0))])).is_err(), "it is not public");
}
