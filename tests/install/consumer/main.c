/* An unknown name is refused with a message, in a C program. */

#include <merge2d/merge2d.h>
#include <stdio.h>
#include <string.h>

int main(void) {
  m2_scene* scene = NULL;
  const m2_status status = m2_scene_load("bokos", NULL, 0, &scene);
  printf("%d: %s\n", (int)status, m2_error());
  return status == M2_INPUT_ERROR && strstr(m2_error(), "books") != NULL ? 0 : 1;
}
