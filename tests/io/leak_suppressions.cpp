/// The H.265 encoder, which only tests use, does not free all of its own memory.
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libx265";
}
