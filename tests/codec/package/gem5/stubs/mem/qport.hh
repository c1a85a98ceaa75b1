// STUB, not gem5.
#include "gem5_stubs.hh"
