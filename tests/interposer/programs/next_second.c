/* next_second: the later library in load order. It defines the function, and a name that the shim exports. */
int probe_number(void);
int probe_number(void) {
  return 2;
}
