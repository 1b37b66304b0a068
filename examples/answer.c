/* Answers a request from standard input, as the program does.
   Usage: answer NAME < REQUEST.json */
#include <stdio.h>
#include <turnwright/turnwright.h>

int main(int argc, char** argv) {
  static char request[2000001];
  turnwright_catalogue* catalogue;
  char* text;
  int status;
  if (argc != 2) return 2;
  request[fread(request, 1, sizeof request - 1, stdin)] = 0;
  status = turnwright_open(NULL, &catalogue, &text);
  if (status == TURNWRIGHT_OK)
    status = turnwright_answer(catalogue, argv[1], request, NULL, &text);
  puts(text ? text : "no memory");
  turnwright_free(text);
  turnwright_close(catalogue);
  return status;
}
