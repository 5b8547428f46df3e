//! Parses statements: in the common grammar of SQLite and PostgreSQL, with the operators of PostGIS.

use sqlparser::ast::{BinaryOperator, Expr, Query, SetExpr, TableFactor};
use sqlparser::dialect::Dialect as Grammar;
use sqlparser::keywords::Keyword;
use sqlparser::parser::{Parser, ParserError};
use sqlparser::tokenizer::{Location, Token, TokenWithSpan, Tokenizer};

use super::walk::asks_for_rows;

/// Maximum number of tokens of a statement that is parsed: more could be nested too deeply.
const MOST_TOKENS: usize = 10_000;

/// Maximum nesting depth of parentheses.
const DEEPEST: usize = 60;

/// Stack size (bytes) for the parser and for work on its trees: enough for the deepest statement of the maximum length.
const STACK: usize = 256 << 20;

/// The common grammar of both databases.
#[derive(Debug)]
struct SharedGrammar;

impl Grammar for SharedGrammar {
    fn is_delimited_identifier_start(&self, letter: char) -> bool {
        matches!(letter, '"' | '`' | '[')
    }

    fn is_identifier_start(&self, letter: char) -> bool {
        letter.is_alphabetic() || letter == '_'
    }

    fn is_identifier_part(&self, letter: char) -> bool {
        letter.is_alphanumeric() || letter == '_'
    }

    fn supports_filter_during_aggregation(&self) -> bool {
        true
    }

    fn supports_limit_comma(&self) -> bool {
        true
    }

    fn supports_dollar_placeholder(&self) -> bool {
        true
    }

    fn supports_in_empty_list(&self) -> bool {
        true
    }

    fn supports_notnull_operator(&self) -> bool {
        true
    }

    fn supports_geometric_types(&self) -> bool {
        true
    }

    fn parse_infix(
        &self,
        parser: &mut Parser,
        left: &Expr,
        precedence: u8,
    ) -> Option<Result<Expr, ParserError>> {
        let operator = if parser.consume_token(&Token::Overlap) {
            BinaryOperator::PGOverlap
        } else {
            parser.parse_keyword(Keyword::GLOB).then_some(BinaryOperator::Glob)?
        };
        let right = parser.parse_subexpr(precedence);
        Some(right.map(|right| Expr::BinaryOp {
            left: Box::new(left.clone()),
            op: operator,
            right: Box::new(right),
        }))
    }
}

/// A statement that returns rows.
pub(crate) struct SyntaxTree {
    /// Query.
    pub query: Box<Query>,
}

/// The error of a statement that cannot be parsed. The message contains the line and column, if known.
#[derive(Debug, Clone)]
pub(crate) struct SyntaxError {
    /// Message of the parser.
    #[cfg_attr(not(feature = "postgis"), allow(dead_code, reason = "SQLite tells of its errors itself"))]
    pub message: String,
}

fn tokens(sql: &str) -> Result<Vec<TokenWithSpan>, SyntaxError> {
    let tokens = Tokenizer::new(&SharedGrammar, sql).tokenize_with_location();
    let tokens = tokens.map_err(|error| SyntaxError { message: error.to_string() })?;
    let mut joined: Vec<TokenWithSpan> = Vec::with_capacity(tokens.len());
    for token in tokens {
        // A quoted name `[1]` of SQLite is an array index if it directly follows another name.
        if let (Some(TokenWithSpan { token: Token::Word(before), span }), Token::Word(word)) =
            (joined.last_mut(), &token.token)
            && word.quote_style == Some('[')
            && before.quote_style.is_none()
            && !word.value.is_empty()
            && word.value.bytes().all(|letter| letter.is_ascii_digit())
        {
            before.value += &format!("[{}]", word.value);
            before.keyword = Keyword::NoKeyword;
            *span = span.union(&token.span);
            continue;
        }
        joined.push(token);
    }
    Ok(joined)
}

/// Parses a statement, which must return rows.
pub(crate) fn parse(sql: &str) -> Result<SyntaxTree, SyntaxError> {
    let tokens = tokens(sql)?;
    if tokens.len() > MOST_TOKENS {
        return Err(SyntaxError { message: format!("it has more than {MOST_TOKENS} words") });
    }
    let mut parser =
        Parser::new(&SharedGrammar).with_recursion_limit(DEEPEST).with_tokens_with_locations(tokens);
    let wrong = |message: &str| Err(SyntaxError { message: message.into() });
    while parser.consume_token(&Token::SemiColon) {}
    if parser.peek_token() == Token::EOF {
        return wrong("it says nothing");
    }
    let unread = |error: ParserError| SyntaxError { message: error.to_string() };
    // The parser's own entry point for statements would link the statements of all databases into the program.
    let query = parser.parse_query().map_err(unread)?;
    let ended = parser.consume_token(&Token::SemiColon);
    while parser.consume_token(&Token::SemiColon) {}
    let next = parser.peek_token();
    if next == Token::EOF {
        return if asks_for_rows(&query) {
            Ok(SyntaxTree { query })
        } else {
            wrong("it does not ask for rows")
        };
    }
    if ended {
        wrong("it holds more than one statement")
    } else {
        parser.expected("end of statement", next).map_err(unread)
    }
}

/// Parses an expression that Burgeon wrote.
pub(super) fn expression(text: &str) -> Option<Expr> {
    let parser = Parser::new(&SharedGrammar).with_recursion_limit(2 * DEEPEST).try_with_sql(text);
    parser.ok()?.parse_expr().ok()
}

/// Parses a relation after FROM that Burgeon wrote.
pub(super) fn relation(text: &str) -> Option<TableFactor> {
    let parsed = parse(&format!("SELECT 1 FROM {text}")).ok()?;
    match *parsed.query.body {
        SetExpr::Select(mut select) => Some(select.from.pop()?.relation),
        _ => None,
    }
}

/// Returns the positions (bytes) of the names after `$` in a statement.
#[cfg(feature = "postgis")]
pub(crate) fn placeholder_ranges(sql: &str) -> Vec<(usize, usize)> {
    let found = tokens(sql).unwrap_or_default().into_iter().filter_map(|token| match &token.token {
        Token::Placeholder(text) if text.starts_with('$') => {
            let begin = offset(sql, token.span.start);
            Some((begin, begin + text.len()))
        }
        _ => None,
    });
    found.collect()
}

/// Returns the position (bytes) of a second statement, if there is one.
pub(crate) fn second_statement(sql: &str) -> Option<usize> {
    let mut ended = false;
    for token in tokens(sql).ok()? {
        match token.token {
            Token::SemiColon => ended = true,
            Token::Whitespace(_) | Token::EOF => {}
            _ if ended => return Some(offset(sql, token.span.start)),
            _ => {}
        }
    }
    None
}

/// Returns the first position (bytes) of a name, or of a parameter with its `$`, in a statement.
pub(crate) fn find_word(sql: &str, word: &str) -> Option<usize> {
    let name = word.rsplit('.').next().unwrap_or(word);
    let found = tokens(sql).ok()?.into_iter().find(|token| match &token.token {
        Token::Word(found) => found.value.eq_ignore_ascii_case(name),
        Token::Placeholder(found) => found == word,
        _ => false,
    });
    found.map(|token| offset(sql, token.span.start))
}

/// Lists the words of a statement that may be names of tables, with their schema if given: those after FROM, JOIN, a
/// comma or a parenthesis.
pub(crate) fn table_words(sql: &str) -> Vec<String> {
    let Ok(tokens) = tokens(sql) else { return Vec::new() };
    let tokens: Vec<Token> = tokens.into_iter().map(|token| token.token).collect();
    let tokens: Vec<&Token> = tokens.iter().filter(|token| !matches!(token, Token::Whitespace(_))).collect();
    let leads = |token: &Token| match token {
        Token::Comma | Token::LParen => true,
        Token::Word(word) => matches!(word.keyword, Keyword::FROM | Keyword::JOIN | Keyword::ONLY),
        _ => false,
    };
    let mut words = Vec::new();
    for (place, token) in tokens.iter().enumerate().skip(1) {
        let Token::Word(word) = token else { continue };
        if !leads(tokens[place - 1]) {
            continue;
        }
        let name = match tokens[place + 1..] {
            [Token::LParen, ..] => continue,
            [Token::Period, Token::Word(table), ..] => format!("{}.{}", word.value, table.value),
            _ => word.value.clone(),
        };
        if !words.contains(&name) {
            words.push(name);
        }
    }
    words
}

/// Converts a line and a column, counted from 1 with columns in characters, to a byte position.
fn offset(sql: &str, at: Location) -> usize {
    let line = usize::try_from(at.line.saturating_sub(1)).unwrap_or(0);
    let column = usize::try_from(at.column.saturating_sub(1)).unwrap_or(0);
    let begin: usize = sql.split_inclusive('\n').take(line).map(str::len).sum();
    let rest = sql.get(begin..).unwrap_or("");
    begin + rest.char_indices().nth(column).map_or(rest.len(), |(index, _)| index)
}

/// Runs `work` with the stack that a statement may need.
pub(super) fn with_stack<T: Send>(work: impl FnOnce() -> T + Send) -> Option<T> {
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().name("sql".into()).stack_size(STACK);
        thread.spawn_scoped(scope, work).ok()?.join().ok()
    })
}
