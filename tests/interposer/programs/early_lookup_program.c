/* early_lookup_program: ends with 2 if both early lookups were answered. */
int early_answer(void);

int main(void) {
  return early_answer();
}
