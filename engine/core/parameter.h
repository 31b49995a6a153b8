#pragma once

#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/chain_stage.h"

/// Parameters are declared once, in the `describe` member of each stage's options struct. One visitor serves the
/// command line, presets, the project file, the window's form, validation, and what sweeps and previews compute anew.
/// Names are "group.name", e.g. "motion.min_speed".
namespace eyrie {

/// What people read about a parameter.
struct ParameterText {
    std::string unit;    ///< "px", "m", "m/s", "frames", "" …
    std::string help;    ///< one or two sentences: what it does, what happens when it grows
    std::string source;  ///< "Teutsch §5.4.1, eq. 5.14", or "" for our own choices
};

/// What of the chain has to be computed anew when a parameter changes, and whether more is needed for it.
struct ParameterEffect {
    ChainStage stage;            ///< the first; `none` for what is no part of the chain, as training
    bool decision_only = false;  ///< of detection nothing that Detector::prepare() does
    bool chooses_model = false;  ///< a value may need a model file, which may be missing or of another kind
};

/// Visits each parameter of an options struct by reference. Parameters are declared through a ParameterDeclarer.
class ParameterVisitor {
 public:
    virtual ~ParameterVisitor() = default;

 private:
    friend class ParameterDeclarer;
    virtual void real(const std::string& name, const ParameterEffect& effect, double& value, double min, double max,
                      const ParameterText& text) = 0;
    virtual void integer(const std::string& name, const ParameterEffect& effect, int& value, int min, int max,
                         const ParameterText& text) = 0;
    virtual void flag(const std::string& name, const ParameterEffect& effect, bool& value,
                      const ParameterText& text) = 0;
    virtual void choice(const std::string& name, const ParameterEffect& effect, int& index,
                        const std::vector<std::string>& names, const ParameterText& text) = 0;
    virtual void words(const std::string& name, const ParameterEffect& effect, std::string& value,
                       const ParameterText& text) = 0;
};

/// Declares the parameters that take effect in one stage; without a stage there is no way to declare one.
class ParameterDeclarer {
 public:
    ParameterDeclarer(ParameterVisitor& visitor, ChainStage stage) : visitor_(visitor), effect_{stage} {}

    /// For parameters of detection that have no part in Detector::prepare(): sweeps prepare search areas once for all
    /// their values. Claimed wrongly, sweeps are wrong.
    ParameterDeclarer decisionOnly() const {
        ParameterDeclarer declarer = *this;
        declarer.effect_.decision_only = true;
        return declarer;
    }

    /// For parameters of which a value may need a model file: sweeps try all their values before they begin.
    ParameterDeclarer choosesModel() const {
        ParameterDeclarer declarer = *this;
        declarer.effect_.chooses_model = true;
        return declarer;
    }

    void real(const std::string& name, double& value, double min, double max, const ParameterText& text) const {
        visitor_.real(name, effect_, value, min, max, text);
    }
    void integer(const std::string& name, int& value, int min, int max, const ParameterText& text) const {
        visitor_.integer(name, effect_, value, min, max, text);
    }
    void flag(const std::string& name, bool& value, const ParameterText& text) const {
        visitor_.flag(name, effect_, value, text);
    }
    /// An enumeration whose enumerators are 0, 1, 2 … in the order of `names`.
    template <class Enum>
    void choice(const std::string& name, Enum& value, const std::vector<std::string>& names,
                const ParameterText& text) const {
        int index = static_cast<int>(value);
        visitor_.choice(name, effect_, index, names, text);
        value = static_cast<Enum>(index);
    }
    /// Any text, such as the path of a file; may be empty.
    void words(const std::string& name, std::string& value, const ParameterText& text) const {
        visitor_.words(name, effect_, value, text);
    }

 private:
    ParameterVisitor& visitor_;
    ParameterEffect effect_;
};

enum class ParameterKind { real, integer, flag, choice, words };

/// A parameter as data: its declaration and its value as text.
struct Parameter {
    std::string name;
    ParameterEffect effect{ChainStage::none};
    ParameterKind kind = ParameterKind::real;
    double min = 0;
    double max = 0;
    std::vector<std::string> choices;
    ParameterText text;
    std::string value;  ///< reals with the shortest text that reads back identically; flags "true" or "false"

    /// "1..500 layers", "one of: clusters, gradient", "true or false", "a text".
    std::string expected() const;
};

/// Anything that shows its parameters to a visitor.
using Describe = std::function<void(ParameterVisitor&)>;

/// All parameters with their present values, in the order of declaration.
std::vector<Parameter> listParameters(const Describe& describe);

/// Sets one parameter from text. Throws Error(parameter): an unknown name (with the nearest known one), or a value that
/// cannot be read or is out of range ("stacking.min_height = 0, expected 1..500 layers"). On an error nothing changes.
void setParameter(const Describe& describe, const std::string& name, const std::string& value);

/// Sets several; either all or, on an error, those before the faulty one.
void setParameters(const Describe& describe, const std::vector<std::pair<std::string, std::string>>& values);

/// `describe` of any options struct with a `describe(ParameterVisitor&)` member. The struct must outlive the result.
template <class Options>
Describe describeOf(Options& options) {
    return [&options](ParameterVisitor& visitor) { options.describe(visitor); };
}

}  // namespace eyrie
