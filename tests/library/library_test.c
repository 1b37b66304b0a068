/* Calls the C library as a program in C does.  Usage: library_test FOLDER VERSION */
#include <pthread.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <turnwright/turnwright.h>

static int failures = 0;

static void check(int holds, const char* claim, const char* shown) {
  if (holds) return;
  ++failures;
  fprintf(stderr, "not so: %s\n  %s\n", claim, shown ? shown : "NULL");
}

static void check_text(const char* text, const char* part, const char* claim) {
  check(text && strstr(text, part), claim, text);
}

/* A cantilever of 100 mm, d = 40 mm, E = 210 GPa, with 1000 N at its end. */
static const char* const kCantilever =
    "{\"shaft\": {\"E_MPa\": 210000, \"nu\": 0.3, \"segments\": [{\"length_mm\": 100,"
    " \"outer_left_mm\": 40, \"outer_right_mm\": 40}]}, \"clamping\": {\"method\":"
    " \"chuck\"}, \"positions_mm\": [100],"
    " \"load\": {\"Fr_N\": 1000, \"Ft_N\": 0, \"Fa_N\": 0}}";

static const char* const kSweep =
    "{\"model\": \"milling\", \"teeth\": 2, \"Kt_MPa\": 600, \"Kn_MPa\": 200,"
    " \"radial_immersion\": 0.1, \"direction\": \"down\", \"modes\": [{\"axis\": \"x\","
    " \"frequency_Hz\": 922, \"damping_ratio\": 0.011, \"mass_kg\": 0.03993}],"
    " \"ap_max_mm\": 6, \"speeds_rpm\": {\"from\": 5000, \"to\": 19000, \"count\": "
    "2000}}";

static double number_behind(const char* text, const char* key) {
  const char* found = text ? strstr(text, key) : NULL;
  return found ? strtod(found + strlen(key), NULL) : 0;
}

/* Euler's F L^3/(3 E I) and Timoshenko's F L/(k G A), k = 6(1 + nu)/(7 + 6 nu). */
static double cantilever_mm(void) {
  const double pi = 3.14159265358979323846, d = 40, L = 100, E = 210000, nu = 0.3;
  const double I = pi * d * d * d * d / 64, A = pi * d * d / 4;
  const double G = E / (2 * (1 + nu)), k = 6 * (1 + nu) / (7 + 6 * nu);
  return 1000 * L * L * L / (3 * E * I) + 1000 * L / (k * G * A);
}

static void answers(const turnwright_catalogue* catalogue) {
  char* answer = NULL;
  int status = turnwright_answer(catalogue, "deflection", kCantilever, NULL, &answer);
  const double e_mm = number_behind(answer, "\"delta_r_mm\":");
  const double error = e_mm / cantilever_mm() - 1;
  check(status == TURNWRIGHT_OK, "a request is answered", answer);
  check(error < 1e-9 && error > -1e-9, "a cantilever bends by the closed form", answer);
  turnwright_free(answer);
}

static void tells_problems(const turnwright_catalogue* catalogue) {
  static const struct {
    const char *name, *request, *told;
    int status;
  } kWrong[] = {
      {"deflection", "{\"shaft\": 7, \"clampin\": {}}", "\"pointer\":\"/shaft\"", 2},
      {"deflection", "{\"shaft\": 7, \"clampin\": {}}", "\"pointer\":\"/clampin\"", 2},
      {"deflection", "", "\"errors\":[{\"pointer\":\"\"", 2},
      {"deflection", "{\"\xff\": 1}", "wrong input", 2},
      {"deflexion", "{}", "one of plan, predict", 2},
      {NULL, NULL, "\"pointer\":\"name\"", 2},
      {NULL, NULL, "\"pointer\":\"request\"", 2}};
  char* answer;
  int status;
  size_t i;
  for (i = 0; i < sizeof kWrong / sizeof *kWrong; ++i) {
    status =
        turnwright_answer(catalogue, kWrong[i].name, kWrong[i].request, NULL, &answer);
    check(status == kWrong[i].status, "wrong input has its status", answer);
    check_text(answer, kWrong[i].told, kWrong[i].told);
    turnwright_free(answer);
  }
  status = turnwright_answer(NULL, "plan", "{}", NULL, &answer);
  check(status == TURNWRIGHT_WRONG_INPUT, "no catalogue is wrong input", answer);
  turnwright_free(answer);
  check(turnwright_answer(catalogue, "plan", "{}", NULL, NULL) == TURNWRIGHT_WRONG_INPUT,
        "nowhere to answer is wrong input", NULL);
}

static void opens_only_catalogues(void) {
  turnwright_catalogue* catalogue;
  char* problem;
  const int status = turnwright_open("/nowhere", &catalogue, &problem);
  check(status == TURNWRIGHT_WRONG_INPUT, "a folder without materials is no catalogue",
        problem);
  check(!catalogue, "there is none", problem);
  check_text(problem, "/nowhere", "the folder is told");
  turnwright_free(problem);
}

struct Sweep {
  turnwright_stop* stop;
  size_t calls, last;
};

static void stop_at_the_third(size_t done, size_t all, void* user) {
  struct Sweep* sweep = user;
  ++sweep->calls;
  check(done > sweep->last && done <= all, "progress rises", NULL);
  sweep->last = done;
  if (sweep->calls == 3) turnwright_stop_request(sweep->stop);
}

static void can_be_stopped(const turnwright_catalogue* catalogue) {
  struct Sweep sweep = {turnwright_stop_new(), 0, 0};
  turnwright_options options = {0};
  char* answer;
  int status;
  options.size = sizeof options;
  options.stop = sweep.stop;
  options.progress = stop_at_the_third;
  options.user = &sweep;
  status = turnwright_answer(catalogue, "stability", kSweep, &options, &answer);
  check(status == TURNWRIGHT_CANCELLED, "a sweep ends where it is stopped", answer);
  check(sweep.calls == 3, "and tells nothing more", answer);
  turnwright_free(answer);
  status = turnwright_answer(catalogue, "deflection", kCantilever, &options, &answer);
  check(status == TURNWRIGHT_CANCELLED, "what comes after a stop is not begun", answer);
  turnwright_free(answer);
  turnwright_stop_free(sweep.stop);
}

static void draws(const turnwright_catalogue* catalogue) {
  turnwright_options options = {0};
  char* answer;
  const char* machine =
      "{\"chain\": \"wCfZXt\", \"tool_point_mm\": [0, 0, 0], \"axes\": [{\"name\": "
      "\"C\"},"
      " {\"name\": \"Z\"}, {\"name\": \"X\"}], \"points\": [{\"q\": {\"X\": 30}}]}";
  const int status =
      turnwright_answer(catalogue, "deflection", kCantilever, &options, &answer);
  check(status == TURNWRIGHT_WRONG_INPUT, "options without their size are refused",
        answer);
  turnwright_free(answer);
  options.size = sizeof options;
  options.drawings = 1;
  turnwright_answer(catalogue, "geometry", machine, &options, &answer);
  check_text(answer, "\"drawings\":[{\"name\":\"errors.svg\",\"svg\":\"<svg",
             "a picture");
  turnwright_free(answer);
  turnwright_answer(catalogue, "deflection", kCantilever, &options, &answer);
  check_text(answer, "\"drawings\":[]", "a capability without pictures has none");
  turnwright_free(answer);
  options.size = offsetof(turnwright_options, drawings);
  turnwright_answer(catalogue, "deflection", kCantilever, &options, &answer);
  check(strstr(answer, "\"drawings\"") == NULL, "a shorter struct has fewer options",
        answer);
  turnwright_free(answer);
  options.size = sizeof options + 1;
  check(turnwright_answer(catalogue, "deflection", kCantilever, &options, &answer) ==
            TURNWRIGHT_WRONG_INPUT,
        "a longer struct is refused", answer);
  turnwright_free(answer);
}

static void* answer_often(void* catalogue) {
  char *first, *next;
  int i, same = 1;
  turnwright_answer(catalogue, "deflection", kCantilever, NULL, &first);
  for (i = 0; i < 50; ++i) {
    turnwright_answer(catalogue, "deflection", kCantilever, NULL, &next);
    same = same && strcmp(first, next) == 0;
    turnwright_free(next);
  }
  if (same) return first;
  turnwright_free(first);
  return NULL;
}

static void serves_threads(turnwright_catalogue* catalogue) {
  pthread_t threads[4];
  void* texts[4];
  int i;
  for (i = 0; i < 4; ++i) pthread_create(&threads[i], NULL, answer_often, catalogue);
  for (i = 0; i < 4; ++i) pthread_join(threads[i], &texts[i]);
  for (i = 0; i < 4; ++i)
    check(texts[i] && texts[0] && strcmp(texts[i], texts[0]) == 0,
          "every thread gets the same bytes", texts[i]);
  for (i = 0; i < 4; ++i) turnwright_free(texts[i]);
}

int main(int argc, char** argv) {
  turnwright_catalogue* catalogue;
  char* text;
  if (argc != 3) return 2;
  check_text(turnwright_version(), argv[2], "the version is that of the build");
  if (turnwright_open(argv[1], &catalogue, &text) != TURNWRIGHT_OK) {
    fprintf(stderr, "no catalogue: %s\n", text);
    return 1;
  }
  check(!text, "an open catalogue has no problem", text);
  check_text(turnwright_folder(catalogue), argv[1], "it knows its folder");
  text = turnwright_capabilities();
  check_text(text, "{\"name\":\"calibrate-material\",\"summary\":", "capabilities");
  turnwright_free(text);
  answers(catalogue);
  tells_problems(catalogue);
  opens_only_catalogues();
  can_be_stopped(catalogue);
  draws(catalogue);
  serves_threads(catalogue);
  turnwright_close(catalogue);
  turnwright_close(NULL);
  turnwright_free(NULL);
  turnwright_stop_request(NULL);
  turnwright_stop_free(NULL);
  return failures != 0;
}
