"""Names of capabilities in Python."""
import keyword


def identifier(name):
    """"calibrate-material" -> "calibrate_material", "import" -> "import_"."""
    name = name.replace("-", "_")
    return name + "_" if keyword.iskeyword(name) else name
