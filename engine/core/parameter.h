#pragma once

#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

/// Parameters are declared once, in the `describe` member of each stage's options struct. One visitor serves the
/// command line, presets, the project file, the window's form, validation and sweeps. Names are "group.name", e.g.
/// "motion.min_speed".
namespace eyrie {

/// What people read about a parameter.
struct ParameterText {
    std::string unit;    ///< "px", "m", "m/s", "frames", "" …
    std::string help;    ///< one or two sentences: what it does, what happens when it grows
    std::string source;  ///< "Teutsch §5.4.1, eq. 5.14", or "" for our own choices
};

/// Visits each parameter of an options struct by reference.
class ParameterVisitor {
 public:
    virtual ~ParameterVisitor() = default;
    virtual void real(const std::string& name, double& value, double min, double max, const ParameterText& text) = 0;
    virtual void integer(const std::string& name, int& value, int min, int max, const ParameterText& text) = 0;
    virtual void flag(const std::string& name, bool& value, const ParameterText& text) = 0;
    /// `index` is a position in `names`.
    virtual void choiceIndex(const std::string& name, int& index, const std::vector<std::string>& names,
                             const ParameterText& text) = 0;
    /// Any text, such as the path of a file; may be empty.
    virtual void words(const std::string& name, std::string& value, const ParameterText& text) = 0;

    /// An enumeration whose enumerators are 0, 1, 2 … in the order of `names`.
    template <class Enum>
    void choice(const std::string& name, Enum& value, const std::vector<std::string>& names,
                const ParameterText& text) {
        int index = static_cast<int>(value);
        choiceIndex(name, index, names, text);
        value = static_cast<Enum>(index);
    }
};

enum class ParameterKind { real, integer, flag, choice, words };

/// A parameter as data: its declaration and its value as text.
struct Parameter {
    std::string name;
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
