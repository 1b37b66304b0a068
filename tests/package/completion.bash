# What completion offers.  Usage: completion.bash FOLDER_OF_TURNWRIGHT COMPLETION
set -euo pipefail
PATH=$1:$PATH
source "$2"

offers() { # offers "words typed" EXPECTED..
  read -ra COMP_WORDS <<< "$1"
  [[ $1 == *' ' ]] && COMP_WORDS+=('')
  COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
  _turnwright
  local want
  for want in "${@:2}"; do
    [[ " ${COMPREPLY[*]} " == *" $want "* ]] || {
      echo "'$1' offers '${COMPREPLY[*]}', not $want" >&2
      exit 1
    }
  done
}

offers 'turnwright pl' plan
offers 'turnwright ' plan calibrate-material serve list --version
offers 'turnwright plan --d' --drawings --data
offers 'turnwright plan --re' --report
offers 'turnwright serve --p' --port --page
offers 'turnwright batch --s' --shard --slurm
offers 'turnwright list m' materials machines
cd "$(mktemp -d)"
touch part.json
offers 'turnwright plan pa' part.json
echo "completion: all offered"
