/// Freed memory is kept from use for as long as an input lasts, not for ten thousand of them: always new memory would
/// take a quarter of the time. Whoever wants longer stacks of what was allocated sets ASAN_OPTIONS.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() {
    return "quarantine_size_mb=16:malloc_context_size=4";
}
