# The first comment of a C++ header says what the file is.
1i /// @file
1,/^#pragma once/s,^// ,/// ,
