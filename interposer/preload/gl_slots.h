// GL slots: how many stubs there are. Read by the assembler too.
#pragma once

#define TP_GL_NAMES 138    // lines of gl_names.def: each has the slot of its number
#define TP_GL_POOL 1024    // slots behind them, given out as functions are looked up
#define TP_GL_KIND_DRAW 0  // TILEPRESS_GL_DRAW
