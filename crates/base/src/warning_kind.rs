//! Kinds of warnings.

/// Kind of a warning, for code.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum WarningKind {
    /// A call that draws nothing.
    DrawsNothing,
    /// A model without triangles.
    EmptyModel,
    /// A module that is neither drawn, rewritten nor used as a context.
    UndrawnModule,
    /// A module of the standard library that the script redeclares, so that it is not drawn.
    HiddenModule,
    /// A rule that returns a list as one branch.
    ReturnedList,
    /// Interpretations of a system without an object.
    NoObject,
    /// A declaration after the derivation, which it cannot affect.
    LateDeclaration,
    /// A rule that an earlier rule always shadows.
    UnreachableRule,
    /// A context that cannot occur.
    ImpossibleContext,
    /// A system that is derived twice, so both models are part of the result.
    DerivedTwice,
    /// Systems of which none is derived.
    NotDerived,
    /// A parameter that is declared twice.
    ParameterTwice,
    /// Modules that would be replaced beyond the maximum depth.
    Depth,
    /// An option or a call without effect in its context.
    NoEffect,
    /// A file that is readable but partly invalid.
    Data,
    /// A valid operation that is probably not intended.
    Doubtful,
    /// A deprecated name with a replacement.
    Deprecated,
    /// A package that is not used, because another package of the same name takes precedence.
    HiddenPackage,
    /// Something in a package that two other packages replace.
    ReplacedTwice,
    /// An installed package that cannot be used.
    BrokenPackage,
    /// A feature that was skipped because of its data.
    SkippedFeature,
    /// A feature that was skipped because it could not be read; its source has already reported it.
    UnreadFeature,
    /// A feature or an object whose result differs from the request.
    SimplifiedFeature,
    /// A file with shapes whose surface has open edges.
    OpenEdges,
    /// A file that is much larger than in another format.
    LargeFile,
    /// A warning that a script gives with `warn`.
    Script,
}

impl WarningKind {
    /// Returns the machine-readable name: the [`code`](Self::code) without `warning.`.
    pub fn name(self) -> &'static str {
        self.code().trim_start_matches("warning.")
    }

    /// Returns the code of the warning among the codes of errors, for strict runs.
    pub fn code(self) -> &'static str {
        match self {
            Self::DrawsNothing => "warning.draws-nothing",
            Self::EmptyModel => "warning.empty-model",
            Self::UndrawnModule => "warning.undrawn-module",
            Self::HiddenModule => "warning.hidden-module",
            Self::ReturnedList => "warning.returned-list",
            Self::NoObject => "warning.no-object",
            Self::LateDeclaration => "warning.late-declaration",
            Self::UnreachableRule => "warning.unreachable-rule",
            Self::ImpossibleContext => "warning.impossible-context",
            Self::DerivedTwice => "warning.derived-twice",
            Self::NotDerived => "warning.not-derived",
            Self::ParameterTwice => "warning.parameter-twice",
            Self::Depth => "warning.depth",
            Self::NoEffect => "warning.no-effect",
            Self::Data => "warning.data",
            Self::Doubtful => "warning.doubtful",
            Self::Deprecated => "warning.deprecated",
            Self::HiddenPackage => "warning.hidden-package",
            Self::ReplacedTwice => "warning.replaced-twice",
            Self::BrokenPackage => "warning.broken-package",
            Self::SkippedFeature => "warning.skipped-feature",
            Self::UnreadFeature => "warning.unread-feature",
            Self::SimplifiedFeature => "warning.simplified-feature",
            Self::OpenEdges => "warning.open-edges",
            Self::LargeFile => "warning.large-file",
            Self::Script => "warning.script",
        }
    }
}
