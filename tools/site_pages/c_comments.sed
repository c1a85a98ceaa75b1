# Makes the comments of the C headers Doxygen's: before a declaration, and behind a member.
1s,^/\* ,/** @file\n * ,
2,$s,^\( *\)/\* ,\1/** ,
s,^\( *[^ /*].*\)/\* ,\1/**< ,
