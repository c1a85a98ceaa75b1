/* next_second: the library behind the other one in load order; defines the function, and a name of the
 * shim's. */
int probe_number(void);
int probe_number(void) {
  return 2;
}
