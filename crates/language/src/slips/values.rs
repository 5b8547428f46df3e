//! Remedies for errors that Luau raises while a script runs.

/// Returns the remedy for a message of Luau about a value of the wrong type.
///
/// ```
/// use burgeon_language::slips::remedy_of_value;
///
/// let message = "attempt to perform arithmetic (add) on string and number";
/// assert_eq!(remedy_of_value(message), Some("join texts with two dots, \"n is \" .. n, or write `n is {n}`"));
/// ```
pub fn remedy_of_value(message: &str) -> Option<&'static str> {
    let starts = |beginning: &str| message.starts_with(beginning);
    let is_operation = starts("attempt to perform arithmetic") || starts("attempt to concatenate");
    Some(if is_operation && message.contains("module") {
        "write modules one after another: return F(1), F(2)"
    } else if starts("attempt to perform arithmetic (add)") && message.contains("string") {
        "join texts with two dots, \"n is \" .. n, or write `n is {n}`"
    } else if starts("attempt to perform arithmetic") && message.contains("nil") {
        "give the value a number before: one side is nil"
    } else if starts("attempt to perform arithmetic") && message.contains("function") {
        "call the function with parentheses: f(x)"
    } else if starts("attempt to perform arithmetic") && message.contains("table") {
        "write numbers, such as list[1]; modules stand one after another: F(1), F(2); the function of a rule begins with this: \
         function(this, n)"
    } else if starts("attempt to perform arithmetic") && message.contains("object") {
        "objects have methods in place of operators: a:union(b) joins solids, and shape({ a, b }) is both shapes as one"
    } else if starts("attempt to index function with") {
        "call the function before its value is read: this:position().z"
    } else if starts("attempt to index nil with") {
        "check that the value exists before one of its fields is read: nothing was assigned to it, or a list is shorter"
    } else if starts("attempt to call a nil value") {
        "check the spelling of the function, and whether it is called with a colon as a method; lists have no methods: \
         table.insert(list, value)"
    } else if starts("attempt to call a table value") || starts("attempt to call a number value") {
        "write an operator or a comma between the two values: only functions are called"
    } else if starts("attempt to concatenate nil") {
        "give the value a text before: one side is nil"
    } else if starts("attempt to compare") {
        "compare two numbers or two texts: tonumber(x) converts a text"
    } else if starts("attempt to yield across") {
        "rules, guards, interpretations and hooks cannot pause: return modules that continue in the next step, or wrap the code in \
         a coroutine of its own, coroutine.wrap(function() ... end)"
    } else if starts("attempt to get length of nil") {
        "check that the list exists: nothing was assigned to it"
    } else {
        return None;
    })
}
