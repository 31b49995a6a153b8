#include "chain/scale/view_options.h"

namespace eyrie {

ViewOptions ViewOptions::thesis() {
    ViewOptions options;
    options.oblique = false;
    return options;
}

void ViewOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::registration);
    declare.flag(
        "view.oblique", oblique,
        {"",
         "Before a new run, look at how metres per pixel change over the picture, as in a view at an angle, by "
         "the size at which moving things look like vehicles and by the camera's way over the ground. The GSD is then "
         "that of the picture's middle. "
         "A run that exists keeps what was found.",
         ""});
}

}  // namespace eyrie
