# Writes OUT, the manual page, from what PROGRAM's --help tells.
function(help text)
  execute_process(COMMAND ${PROGRAM} ${ARGN} --help OUTPUT_VARIABLE said
                  COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE "\\" "\\e" said "${said}")
  string(REGEX REPLACE "\n([.'])" "\n\\\\&\\1" said "\n${said}")
  string(REPLACE "-" "\\-" said "${said}")
  set(${text} "${said}" PARENT_SCOPE)
endfunction()

help(whole)
set(page ".TH TURNWRIGHT 1 \"\" \"Turnwright ${VERSION}\" \"User Commands\"
.SH NAME
turnwright \\- certified plans of turned parts
.SH DESCRIPTION
.nf${whole}.fi
")
string(REGEX MATCH "Subcommands:\n(  [^\n]*\n)+" table "${whole}")
string(REGEX MATCHALL "\n  [a-z\\-]+" names "${table}")
foreach(name IN LISTS names)
  string(REGEX REPLACE "[\n \\]" "" name "${name}")
  help(one ${name})
  string(TOUPPER ${name} title)
  string(APPEND page ".SH ${title}\n.nf${one}.fi\n")
endforeach()
string(APPEND page ".SH ENVIRONMENT
.TP
TURNWRIGHT_DATA
folder with materials/, tools/, machines/, shops/, parts/ and schemas/, in place of the one that was
installed.
.TP
TURNWRIGHT_LANGUAGE
language of help, messages and reports, en or de.
.TP
XDG_STATE_HOME
turnwright/jobs.sqlite in there keeps the batches of turnwright serve.
")
file(WRITE ${OUT} "${page}")
