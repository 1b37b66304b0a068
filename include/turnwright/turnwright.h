#ifndef TURNWRIGHT_TURNWRIGHT_H
#define TURNWRIGHT_TURNWRIGHT_H
#include <stddef.h>

/**
 * @file
 * The C library of Turnwright, libturnwright: every capability of the command line as a
 * function from a JSON document to a JSON document.
 *
 *     turnwright_catalogue* catalogue;
 *     char* answer;
 *     if (turnwright_open(NULL, &catalogue, &answer) == TURNWRIGHT_OK) {
 *       int status = turnwright_answer(catalogue, "plan", part, NULL, &answer);
 *       puts(answer);
 *       turnwright_free(answer);
 *       turnwright_close(catalogue);
 *     }
 *
 * Text is UTF-8 and ends with a zero.  Text that a function gives is the caller's, who
 * returns it by turnwright_free(); text that is handed in is only read, and not kept.
 *
 * All functions may be called from any number of threads at once, also with one catalogue.
 * The same request has the same answer, byte for byte, from every thread and in every
 * process of one version.  No C++ exception leaves the library, and it prints nothing.
 */

#if defined(__GNUC__)
#define TURNWRIGHT_API __attribute__((visibility("default")))
#else
#define TURNWRIGHT_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** What a function came to.  The numbers are those of the program's exit codes. */
enum turnwright_status {
  /** The answer is the result document.  That a part cannot be made is a result, too: its
      `status` is then "infeasible". */
  TURNWRIGHT_OK = 0,
  /** The request or an argument is wrong; the answer lists every problem. */
  TURNWRIGHT_WRONG_INPUT = 2,
  /** The request lies outside the range a model holds for; the answer says which. */
  TURNWRIGHT_OUTSIDE_RANGE = 3,
  /** A stop was requested before the result was there. */
  TURNWRIGHT_CANCELLED = 4,
  /** A fault of the library, or no memory. */
  TURNWRIGHT_INTERNAL = 70
};

/** The materials, tools and machines that requests refer to by id.  It does not change. */
typedef struct turnwright_catalogue turnwright_catalogue;

/** A wish to end a call early, from another thread or from its progress function. */
typedef struct turnwright_stop turnwright_stop;

/**
 * Called by long sweeps after each of their parts, in the thread that called
 * turnwright_answer().  It must return normally, not by longjmp or an exception.
 * @param done, all  parts computed, and all parts of the sweep; 0 < done <= all.
 * @param user       as in the options.
 */
typedef void (*turnwright_progress)(size_t done, size_t all, void* user);

/** What a call may be given beside its request.  Set all to zero, then `size`. */
typedef struct turnwright_options {
  /** sizeof(turnwright_options).  A later library may know more members; those beyond this
      size count as zero. */
  size_t size;
  turnwright_stop* stop;        /**< outlives the call; NULL: the call runs to its end */
  turnwright_progress progress; /**< NULL: nobody wants to know */
  void* user;                   /**< handed to `progress` */
  /** Not 0: the answer is an object of `result`, `drawings`, an array of `name` ("setup-1.svg")
      and `svg`, and, where the capability has one, `report`, a page of HTML.  Capabilities
      without pictures give an empty array. */
  int drawings;
} turnwright_options;

/** The library's version, "0.1.0"; the library keeps the text. */
TURNWRIGHT_API const char* turnwright_version(void);

/**
 * The capabilities, an array of objects: `name`, `summary`, `example` (a request that can
 * be answered as it stands), `request_schema` and `result_schema` (files in schemas/),
 * `drawings` (whether it has any).
 * @return NULL if there is no memory.
 */
TURNWRIGHT_API char* turnwright_capabilities(void);

/**
 * Reads a catalogue.
 * @param folder     with materials/, tools/ and machines/.  NULL: the folder that
 *                   TURNWRIGHT_DATA of the environment names, else share/turnwright beside
 *                   the library, else of the program, else the sources it was built from.
 * @param catalogue  receives the catalogue, to be closed by turnwright_close(); NULL if
 *                   there is none.
 * @param problem    receives NULL, or as turnwright_answer() what is wrong.
 * @return a turnwright_status.
 */
TURNWRIGHT_API int turnwright_open(const char* folder, turnwright_catalogue** catalogue,
                                   char** problem);

/** Gives the catalogue back when no call uses it any more; NULL is allowed. */
TURNWRIGHT_API void turnwright_close(turnwright_catalogue* catalogue);

/** The folder that the catalogue was read from; the catalogue keeps the text. */
TURNWRIGHT_API const char* turnwright_folder(const turnwright_catalogue* catalogue);

/**
 * Answers a request.
 * @param name     of the capability, "plan".
 * @param request  the request document, at most 2 MB of JSON.
 * @param options  NULL: none.
 * @param answer   receives the result document if the status is TURNWRIGHT_OK, otherwise an
 *                 object of `title`, `detail` and, for wrong input, `errors`: each with the
 *                 JSON `pointer` of its place, what it `got`, what was `expected`, and a
 *                 `code`.  NULL if there is no memory.  It is to be freed in every case.
 * @return a turnwright_status.
 */
TURNWRIGHT_API int turnwright_answer(const turnwright_catalogue* catalogue,
                                     const char* name, const char* request,
                                     const turnwright_options* options, char** answer);

/** Frees a text that a function gave; NULL is allowed. */
TURNWRIGHT_API void turnwright_free(char* text);

/** A stop that has not been requested; NULL if there is no memory. */
TURNWRIGHT_API turnwright_stop* turnwright_stop_new(void);

/** Ends every call that was given this stop, and those that will be.  They return within
    about a second.  NULL is allowed. */
TURNWRIGHT_API void turnwright_stop_request(turnwright_stop* stop);

/** Gives the stop back when no call uses it any more; NULL is allowed. */
TURNWRIGHT_API void turnwright_stop_free(turnwright_stop* stop);

#ifdef __cplusplus
}
#endif
#endif
